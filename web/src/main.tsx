import { render } from "preact";
import "leaflet/dist/leaflet.css";
import "./style/main.css";
import { App } from "./app";
import { Commands } from "./link/commands";
import { Connection } from "./link/connection";
import { decodeFrame } from "./link/frames";
import { followTheme } from "./state/settings";
import { Store } from "./state/store";

const kBeat_ms = 250;

const commands = new Commands((text) => connection.send(text));
const store = new Store((ack) => {
  commands.acknowledged(ack);
});
const connection = new Connection(
  () => new WebSocket(new URL("live", document.baseURI.replace(/^http/, "ws"))),
  {
    onState(state) {
      if (state.kind === "waiting") commands.connectionLost();
      store.connection.value = state;
    },
    onText(text) {
      store.takeText(text);
    },
    onBinary(buffer) {
      const frame = decodeFrame(buffer);
      if (frame !== null) store.takeFrame(frame, performance.now());
    },
  },
);

followTheme();
setInterval(() => {
  store.now_ms.value = performance.now();
}, kBeat_ms);
connection.start();

const root = document.getElementById("app");
if (root !== null) {
  render(
    <App
      store={store}
      commands={commands}
      retry={() => {
        connection.retryNow();
      }}
    />,
    root,
  );
}

import { render } from "preact";
import "leaflet/dist/leaflet.css";
import "./style/main.css";
import { Control } from "./control/control";
import { Api } from "./link/api";
import { Commands } from "./link/commands";
import { Connection } from "./link/connection";
import { decodeFrame } from "./link/frames";
import { unpack } from "./link/packed";
import { signal } from "@preact/signals";
import type { MapAccess } from "./map/map_access";
import { PayloadRequests } from "./payload/payload_requests";
import { Session } from "./sign_in/session";
import { Shell } from "./shell/shell";
import type { Station } from "./shell/station";
import { recordingIn, replay } from "./state/replay";
import { followTheme } from "./state/settings";
import { Store } from "./state/store";
import { Player } from "./timeline/player";

const kBeat_ms = 250;

const recording = recordingIn(location.search);
const kAsked = recording === null ? "" : `?recording=${encodeURIComponent(recording)}`;
if (recording !== null) replay.value = { kind: "log", name: recording };

const commands = new Commands((text) => connection.send(text));
const control = new Control(commands);
const store = new Store(
  (ack) => {
    commands.acknowledged(ack);
  },
  (message) => {
    control.takeMessage(message, performance.now());
  },
);
const connection = new Connection(
  () => new WebSocket(new URL(`live${kAsked}`, document.baseURI.replace(/^http/, "ws"))),
  {
    onState(state) {
      if (state.kind === "waiting") commands.connectionLost();
      // A browser doesn't tell why a WebSocket was refused.
      if (state.kind === "open" || state.kind === "waiting") void session.check();
      store.connection.value = state;
      // In a recording there is nothing to command.
      if (state.kind === "open" && recording === null) control.join();
    },
    onText(text) {
      store.takeText(text);
    },
    onBinary(buffer) {
      const content = unpack(buffer);
      if (typeof content === "string") {
        store.takeText(content);
        return;
      }
      const frame = content === null ? null : decodeFrame(content);
      if (frame !== null) store.takeFrame(frame, performance.now());
    },
  },
);

const api = new Api(document.baseURI);
const session = new Session(
  api,
  () => {
    connection.signedOut();
  },
  () => {
    connection.retryNow();
  },
);

followTheme();
setInterval(() => {
  store.beat(performance.now());
}, kBeat_ms);
connection.start();

const station: Station = {
  store,
  commands,
  control,
  api,
  session,
  payloads: new PayloadRequests(store, commands),
  player: new Player(store, commands, api),
  map: signal<MapAccess | null>(null),
  retry: () => {
    connection.retryNow();
  },
};

const root = document.getElementById("app");
if (root !== null) render(<Shell station={station} />, root);

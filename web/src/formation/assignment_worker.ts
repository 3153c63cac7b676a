import { assign, type Points } from "./assignment";

self.onmessage = (event: MessageEvent<[Points, Points]>) => {
  self.postMessage(assign(...event.data));
};

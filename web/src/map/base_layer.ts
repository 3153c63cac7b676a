import { computed, effect, type ReadonlySignal, type Signal } from "@preact/signals";
import type L from "leaflet";
import type { Hello } from "../link/messages";
import type { Theme } from "../state/settings";
import type { BaseMap } from "./layers";
import { baseInForce, tileLayerFor } from "./tile_layers";

/** Shows the base map that is chosen, or says in `problem` why it can't. What is returned ends that. */
export function keepBase(
  map: L.Map,
  hello: ReadonlySignal<Hello | null>,
  wanted: ReadonlySignal<BaseMap>,
  theme: ReadonlySignal<Theme>,
  problem: Signal<string>,
): () => void {
  // Every connection says hello anew: the map is made anew only if others are served.
  const served = computed(() => {
    const { tiles, tile_url, tile_attribution } = hello.value ?? {};
    return JSON.stringify([tiles, tile_url, tile_attribution]);
  });
  return effect(() => {
    void served.value;
    return showBase(map, hello.peek(), wanted.value, theme.value, problem);
  });
}

function showBase(
  map: L.Map,
  hello: Hello | null,
  wanted: BaseMap,
  theme: Theme,
  problem: Signal<string>,
): () => void {
  let gone = false;
  let shown: L.GridLayer | null = null;
  problem.value = "";
  const complain = (why: string) => {
    if (!gone) problem.value = `The base map can't be shown: ${why}`;
  };
  tileLayerFor(hello, baseInForce(hello, wanted), theme).then(
    (layer) => {
      if (gone || layer === null) return;
      shown = layer;
      // A map has edges and holes; something is wrong only when nothing comes of what was asked for last.
      let came = false;
      let failed = false;
      layer.on("loading", () => {
        came = failed = false;
      });
      layer.on("tileload", () => {
        came = true;
      });
      layer.on("tileerror", () => {
        failed = true;
      });
      layer.on("load", () => {
        if (failed && !came) complain("none of its tiles has come for this place");
        else if (came && !gone) problem.value = "";
      });
      layer.addTo(map);
    },
    (error: unknown) => {
      complain(error instanceof Error ? error.message : String(error));
    },
  );
  return () => {
    gone = true;
    shown?.remove();
  };
}

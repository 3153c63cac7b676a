import type { Store } from "../state/store";
import { kPatience_ms, type PayloadRequests } from "./payload_requests";

/** More names than these make no sentence. */
const kMostNames = 3;

/** Who hasn't followed and what may be the reason, for people; "" when all have. */
export function lateSentence(store: Store, payloads: PayloadRequests, now_ms: number): string {
  const { on, off } = payloads.late(now_ms);
  return [sentence(store, on, "on"), sentence(store, off, "off")].filter(Boolean).join(" ");
}

function sentence(store: Store, ids: readonly number[], wanted: string): string {
  if (ids.length === 0) return "";
  const names =
    ids.length > kMostNames
      ? `${ids.length} UAVs`
      : ids
          .map((id) => store.callsign(id))
          .join(", ")
          .replace(/, ([^,]*)$/, " and $1");
  const lost = ids.filter((id) => store.fleet.isLost(id)).length;
  const links = ids.length === 1 ? "the data link is lost" : "their data links are lost";
  const why =
    lost === 0 ? "" : lost === ids.length ? `: ${links}` : `: ${lost} of them have lost the data link`;
  return `${names}: telemetry does not show the payload ${wanted} ${kPatience_ms / 1000} s after it was asked for${why}.`;
}

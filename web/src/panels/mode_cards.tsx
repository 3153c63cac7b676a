import { kLinkLost } from "../state/fleet";
import type { FormationStatus } from "../link/messages";
import type { Store } from "../state/store";
import { clock, duration } from "../units/format";
import { withLossAge } from "../units/loss_text";
import { inChosenUnits } from "../units/station_text";
import { endOf, kModes, sameWords } from "./mode_text";

/** More formations than this have two lines each instead of a card. */
const kMostCards = 3;
const kShapes: Readonly<Record<string, string>> = {
  line_abreast: "line abreast",
  echelon_left: "echelon left",
  echelon_right: "echelon right",
};

/** What the station is doing with each formation, why, since when and until when. */
export function ModeCards({ store }: { store: Store }) {
  const statuses = [...store.statuses.value.values()].sort((a, b) => a.formation_id - b.formation_id);
  return (
    <ul
      class={statuses.length > kMostCards ? "modes compact" : "modes"}
      aria-label="Formations"
      // Where they need scrolling, the keyboard must get there.
      tabIndex={0}
    >
      {statuses.map((status) => (
        <ModeCard key={status.formation_id} store={store} status={status} />
      ))}
    </ul>
  );
}

function ModeCard({ store, status }: { store: Store; status: FormationStatus }) {
  const formation = store.formations.value.get(status.formation_id);
  const shape = formation === undefined ? "" : (kShapes[formation.shape] ?? formation.shape);
  const mode = kModes[status.mode] ?? `Mode ${status.mode}`;
  const name = formation?.name ? formation.name : `Formation ${status.formation_id}`;
  const text = inChosenUnits(withLossAge(status.mode_text, lossAge_s(store, status)));
  return (
    <li class="panel mode-card" data-mode={status.mode} data-formation={status.formation_id}>
      <p class="mode-head">
        <span class="mode-name">{mode}</span>
        <span class="mode-of">
          {name}
          {shape !== "" && shape !== name.toLowerCase() && `, ${shape}`}
        </span>
      </p>
      {!sameWords(status.mode_text, mode) && <p class="mode-text">{text}</p>}
      <Times store={store} status={status} hold={formation?.hold ?? false} />
    </li>
  );
}

/** Since the longest lost of its UAVs was heard or obeyed [s]; null: none is lost. */
function lossAge_s(store: Store, { slots }: FormationStatus): number | null {
  const { fleet } = store;
  const now_ms = store.now_ms.value;
  const ages_s = slots.flatMap(({ vehicle_id }) => {
    const row = fleet.statusRow(vehicle_id);
    if (row < 0 || fleet.status === null) return [];
    if (fleet.status.downlink[row] === kLinkLost) return [fleet.downlinkAge_s(vehicle_id, now_ms)];
    return fleet.status.uplink[row] === kLinkLost ? [fleet.uplinkAge_s(vehicle_id, now_ms)] : [];
  });
  const oldest_s = Math.max(-1, ...ages_s);
  return oldest_s < 0 ? null : oldest_s;
}

interface TimesProps {
  store: Store;
  status: FormationStatus;
  hold: boolean;
}

function Times({ store, status, hold }: TimesProps) {
  const start_utime = store.roster.value?.start_utime ?? status.mode_utime;
  const utime = store.utimeAt(store.now_ms.value) ?? status.utime;
  const at = (event_utime: number) => `T+ ${clock((event_utime - start_utime) / 1e6)}`;
  const left_s = Math.ceil((status.mode_end_utime - utime) / 1e6);
  return (
    <p class="mode-since">
      <span class="mode-from">
        since {at(status.mode_utime)} ({duration((utime - status.mode_utime) / 1e6)})
      </span>
      <span class="mode-end">
        {status.mode_end_utime === 0
          ? endOf(status.mode, hold)
          : `${left_s > 0 ? `${duration(left_s)} to go, until` : "due at"} ${at(status.mode_end_utime)}`}
      </span>
    </p>
  );
}

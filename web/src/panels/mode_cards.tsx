import type { FormationStatus } from "../link/messages";
import type { Store } from "../state/store";
import { clock, duration } from "../units/format";

/** formation_status_t's modes. */
export const kModes = ["Assembling", "In formation", "Avoiding", "Rejoining", "Holding", "Waiting"] as const;
/** More formations than this have a line each instead of a card. */
const kMostCards = 3;
const kShapes: Readonly<Record<string, string>> = {
  line_abreast: "line abreast",
  echelon_left: "echelon left",
  echelon_right: "echelon right",
};

/** What the station is doing with each formation, and since when. */
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
  return (
    <li class="panel mode-card" data-mode={status.mode}>
      <p class="mode-head">
        <span class="mode-name">{mode}</span>
        <span class="mode-of">
          {name}
          {shape !== "" && shape !== name.toLowerCase() && `, ${shape}`}
        </span>
      </p>
      {!sameWords(status.mode_text, mode) && <p class="mode-text">{status.mode_text}</p>}
      <Since store={store} status={status} />
    </li>
  );
}

/** A text that only repeats the mode's name says nothing. */
function sameWords(text: string, mode: string): boolean {
  return text === "" || text.toLowerCase() === mode.toLowerCase();
}

function Since({ store, status }: { store: Store; status: FormationStatus }) {
  const start_utime = store.roster.value?.start_utime ?? status.mode_utime;
  const utime = store.utimeAt(store.now_ms.value) ?? status.utime;
  const ends =
    status.mode_end_utime > 0 ? `, until T+ ${clock((status.mode_end_utime - start_utime) / 1e6)}` : "";
  return (
    <p class="mode-since">
      since T+ {clock((status.mode_utime - start_utime) / 1e6)} ({duration((utime - status.mode_utime) / 1e6)}
      ){ends}
    </p>
  );
}

import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import type { Outcome } from "../link/commands";
import type { BusEvent, Vehicle } from "../link/messages";
import { CommandButton } from "../panels/command_button";
import { Chain, kLinkNames } from "../panels/icons";
import { NumberField } from "../panels/number_field";
import type { PanelProps } from "../shell/panel_props";
import { Choice } from "../shell/settings_menu";
import { uavRow } from "../state/rows";
import { percent, seconds } from "../units/quantities";
import {
  forEach,
  kLongestDelay_s,
  lastWords,
  linkBody,
  qualityProblem,
  type CutKind,
  type Direction,
  type LinkAction,
  type LinkRequest,
} from "./link_request";

/** More rows than this are a scroll and no list. */
const kMostRows = 50;
const kLongestCut_s = 1e6;

export function LinkControls({ station }: PanelProps) {
  const { store, commands } = station;
  const direction = useSignal<Direction>("both");
  const kind = useSignal<CutKind>("silent");
  const numbers = useSignal({ for_s: 0, delay_s: 0, jitter_s: 0, loss: 0 });
  const request: LinkRequest = { direction: direction.value, kind: kind.value, ...numbers.value };

  const vehicles = store.roster.value?.vehicles ?? [];
  const selected = vehicles.filter(({ id }) => store.selection.value.has(id));
  const meant = selected.length > 0 ? selected : vehicles;
  const send = (action: LinkAction, to: readonly Vehicle[]) => (): Promise<Outcome> =>
    forEach(
      to.map(({ id }) => id),
      (id) => commands.request("CMD_LINK", linkBody(id, action, request)),
      (id) => store.callsign(id),
    );
  const number = (label: string, key: "for_s" | "delay_s" | "jitter_s", most: number, zero?: string) => (
    <Field label={label}>
      <NumberField
        label={label}
        value={numbers.value[key]}
        quantity={seconds}
        least={0}
        most={most}
        decimals={2}
        {...(zero === undefined ? {} : { zero })}
        commit={(value) => {
          numbers.value = { ...numbers.value, [key]: value };
        }}
      />
      <span class="unit">s</span>
    </Field>
  );
  const whose =
    selected.length > 0
      ? selected.length === 1
        ? (selected[0]?.callsign ?? "")
        : `${selected.length} selected UAVs`
      : `all ${vehicles.length} UAVs`;
  const problem = qualityProblem(request);

  return (
    <section aria-labelledby="links-title">
      <h3 id="links-title">Data links of {whose}</h3>
      <p class="hint">
        {selected.length > 0
          ? "Clear the selection to mean all."
          : "Select UAVs in the table or on the map to mean only those."}
      </p>
      <Choice
        label="Direction"
        value={direction}
        choices={[
          ["both", "Both"],
          ["up", "Uplink"],
          ["down", "Downlink"],
        ]}
      />
      <Choice
        label="A cut link"
        value={kind}
        choices={[
          ["silent", "Falls silent"],
          ["frozen", "Repeats its state"],
        ]}
      />
      {number("For", "for_s", kLongestCut_s, "always")}
      <div class="row">
        <CommandButton
          label={`Cut the links of ${whose}`}
          disabled={meant.length === 0}
          command={send("cut", meant)}
        >
          Cut
        </CommandButton>
        <CommandButton
          label={`Restore the links of ${whose}, without delay or loss`}
          disabled={meant.length === 0}
          command={send("restore", meant)}
        >
          Restore
        </CommandButton>
      </div>
      {number("Delay", "delay_s", kLongestDelay_s)}
      {number("Jitter", "jitter_s", kLongestDelay_s)}
      <Field label="Loss">
        <NumberField
          label="Loss"
          value={numbers.value.loss}
          quantity={percent}
          least={0}
          most={1}
          decimals={1}
          commit={(loss) => {
            numbers.value = { ...numbers.value, loss };
          }}
        />
        <span class="unit">%</span>
      </Field>
      <div class="row">
        <CommandButton
          label={`Set delay and loss of ${whose}`}
          disabled={meant.length === 0 || problem !== ""}
          command={send("quality", meant)}
        >
          Set delay and loss
        </CommandButton>
        <span class="hint" role="status">
          {problem}
        </span>
      </div>
      <LinkList station={station} vehicles={meant} />
    </section>
  );
}

function Field({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div class="choice">
      <span aria-hidden="true">{label}</span>
      <span class="with-unit">{children}</span>
    </div>
  );
}

/** How the links are: what telemetry shows, and what the simulator said it did last. */
function LinkList({ station, vehicles }: PanelProps & { vehicles: readonly Vehicle[] }) {
  const { store } = station;
  const now_ms = store.now_ms.value;
  const words = lastWords(store.events.value, store.roster.value?.start_utime ?? 0);
  // Those of whom there is something to tell come first, when not all have room.
  const shown = [...vehicles]
    .sort((a, b) => Number(words.has(b.id)) - Number(words.has(a.id)) || a.id - b.id)
    .slice(0, kMostRows);
  return (
    <>
      <ul class="links" aria-label="Links">
        {shown.map((vehicle) => {
          const row = uavRow(store.fleet, vehicle, now_ms);
          return (
            <li key={vehicle.id} data-id={vehicle.id}>
              <span class="person">{vehicle.callsign}</span>
              <Chain state={row.downlink} label={`Downlink ${kLinkNames[row.downlink] ?? "unknown"}`} />
              <Chain state={row.uplink} label={`Uplink ${kLinkNames[row.uplink] ?? "unknown"}`} />
              <span class="hint last-word">{wordOf(words.get(vehicle.id), vehicle.callsign)}</span>
            </li>
          );
        })}
      </ul>
      {vehicles.length > shown.length && (
        <p class="hint">and {vehicles.length - shown.length} more: select those that you want to see.</p>
      )}
    </>
  );
}

/** The simulator's sentence without the callsign, which stands beside it. */
function wordOf(event: BusEvent | undefined, callsign: string): string {
  return event === undefined ? "as in the scenario" : event.text.replace(` of ${callsign}`, "");
}

import { useRef } from "preact/hooks";
import type { Formation } from "../link/messages";
import { CommandButton } from "../panels/command_button";
import { Icon } from "../shell/icon";
import type { PanelProps } from "../shell/panel_props";
import { Popover } from "../shell/popover";
import { useShortcuts } from "../shell/shortcuts";
import { command, concerned, nameOf } from "./hold";
import "./hold.css";

/**
 * Always in reach, also where nobody has taken control. One key holds, for holding is safe whoever pressed it by accident; to fly on takes a second key. With several
 * formations, both are for all of them, and a list has them one by one.
 */
export function HoldControl({ station }: PanelProps) {
  const { store, commands, control } = station;
  const root = useRef<HTMLDivElement>(null);
  const press = (which: string) => {
    root.current?.querySelector<HTMLButtonElement>(`.${which}`)?.click();
  };
  useShortcuts([
    {
      keys: "h",
      label: "Hold: all formations loiter where they are",
      group: "Flight",
      over_dialogs: true,
      run: () => {
        press("hold-all");
      },
    },
    {
      keys: "Shift+h",
      label: "Resume: all formations fly on",
      group: "Flight",
      run: () => {
        press("resume-all");
      },
    },
  ]);
  const formations = store.formations.value;
  const to_hold = concerned(formations, "hold");
  const to_resume = concerned(formations, "resume");
  const [only] = formations.size === 1 ? [...formations.values()] : [];
  const whose = only === undefined ? "all formations" : nameOf(only);
  return (
    <div class="hold-control" ref={root} role="group" aria-label="Hold">
      <CommandButton
        class={to_resume.length > 0 && to_hold.length === 0 ? "button hold-all holding" : "button hold-all"}
        label={`Hold ${whose} (H)`}
        disabled={to_hold.length === 0}
        urgent
        command={() => control.takenIfFree(() => command(commands, "hold", to_hold))}
      >
        <Icon name="hold" />
        {to_resume.length > 0 && to_hold.length === 0 ? "Holding" : "Hold"}
      </CommandButton>
      <CommandButton
        class="button resume-all"
        label={`Resume ${whose} (Shift+H)`}
        disabled={to_resume.length === 0}
        command={() => command(commands, "resume", to_resume)}
      >
        Resume
      </CommandButton>
      {formations.size > 1 && (
        <Popover label="Hold one by one" button="▾">
          <ul class="hold-list">
            {[...to_hold, ...to_resume]
              .sort((a, b) => a.formation_id - b.formation_id)
              .map((formation) => (
                <HoldRow key={formation.formation_id} station={station} formation={formation} />
              ))}
          </ul>
        </Popover>
      )}
    </div>
  );
}

function HoldRow({ station, formation }: PanelProps & { formation: Formation }) {
  const action = formation.hold ? "resume" : "hold";
  const word = formation.hold ? "Resume" : "Hold";
  const send = () => {
    const press = () => command(station.commands, action, [formation]);
    return action === "hold" ? station.control.takenIfFree(press) : press();
  };
  return (
    <li>
      <span>{nameOf(formation)}</span>
      <span class="hint">{formation.hold ? "holding" : ""}</span>
      <CommandButton label={`${word} ${nameOf(formation)}`} urgent={action === "hold"} command={send}>
        {word}
      </CommandButton>
    </li>
  );
}

import type { Control } from "../control/control";
import { youOf } from "../control/people";
import type { Commands, Outcome } from "../link/commands";
import type { AlarmBody } from "../link/messages";

interface Desk {
  readonly commands: Commands;
  readonly control: Control;
}

/** Sends it with the name by which the others know this person: they see who looks after an alarm. */
export function sendAlarm({ commands, control }: Desk, body: AlarmBody): Promise<Outcome> {
  const name = control.state.value === null ? "" : (youOf(control.state.value)?.name ?? "");
  return commands.request("CMD_ALARM", name === "" ? body : { ...body, operator_name: name });
}

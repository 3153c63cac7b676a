import { person_name } from "../control/control";
import type { Commands, Outcome } from "../link/commands";
import type { AlarmBody } from "../link/messages";

/** Sends it with the name of the person at this browser, when there is one: others see who looks after an alarm. */
export function sendAlarm(commands: Commands, body: AlarmBody): Promise<Outcome> {
  const name = person_name.value.trim();
  return commands.request("CMD_ALARM", name === "" ? body : { ...body, operator_name: name });
}

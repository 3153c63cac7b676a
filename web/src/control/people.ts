/** Who holds control, as web-bridge tells it (cpp/bridge/README.md), and what that means for the person at this page. */

export interface Person {
  id: number;
  name: string;
  may_operate: boolean;
  /** Its connection is gone; control is kept for so long [s]. Null while it is there. */
  kept_for_s: number | null;
  /** It asks for control, and may take over after so long without an answer [s]. Null while it does not ask. */
  waits_for_s: number | null;
}

export interface ControlMessage {
  type: "control";
  /** 0: this page has not introduced itself. */
  you: number;
  token: string;
  may_operate: boolean;
  /** 0: nobody. */
  holder: number;
  people: Person[];
}

export const kLongestName = 40;

export function holderOf(control: ControlMessage): Person | null {
  return control.people.find(({ id }) => id === control.holder) ?? null;
}

export function youOf(control: ControlMessage): Person | null {
  return control.people.find(({ id }) => id === control.you) ?? null;
}

export function youHold(control: ControlMessage | null): boolean {
  return control !== null && control.you !== 0 && control.holder === control.you;
}

/** Everybody else, who asks first of all. */
export function othersOf(control: ControlMessage): Person[] {
  return control.people
    .filter(({ id }) => id !== control.you)
    .sort((a, b) => Number(b.waits_for_s !== null) - Number(a.waits_for_s !== null) || a.id - b.id);
}

/** Nobody holds control, and this page's person may take it. */
export function isFreeForYou(control: ControlMessage | null): boolean {
  return control !== null && control.you !== 0 && control.may_operate && control.holder === 0;
}

/** Why this page may not command, "" when it may, or when nothing is known yet: the bridge decides. */
export function whyNot(control: ControlMessage | null): string {
  if (control === null || control.you === 0 || youHold(control)) return "";
  const holder = holderOf(control);
  return holder === null
    ? "Nobody holds control: take it in the bar at the top"
    : `${holder.name} holds control`;
}

/**
 * What has changed for the person at this page in a way that has to be told; null: nothing. `before` is what was known when it was last
 * among the people: after a connection that was gone for long it has another number, and somebody else may have control.
 */
export function newsOf(before: ControlMessage | null, now: ControlMessage): string | null {
  if (before === null || before.you === 0 || now.you === 0) return null;
  const [held, holds] = [youHold(before), youHold(now)];
  if (held && !holds) {
    const holder = holderOf(now);
    return holder === null ? null : `${holder.name} has control now. You are looking on.`;
  }
  if (!held && holds && before.holder !== 0) return "You have control now.";
  if (before.you !== now.you) return null;
  const asked = youOf(before)?.waits_for_s ?? null;
  if (!holds && asked !== null && youOf(now)?.waits_for_s === null && before.holder === now.holder)
    return `${holderOf(now)?.name ?? "Nobody"} keeps control.`;
  return null;
}

/** What is wrong with a name as it is typed, "" when nothing is. */
export function nameProblem(name: string): string {
  const length = [...name.trim()].length;
  if (length === 0) return "Type the name by which the others know you.";
  if (length > kLongestName) return `Use ${kLongestName} characters or less.`;
  // eslint-disable-next-line no-control-regex -- that is what is looked for
  if (/[\u0000-\u001f\u007f]/.test(name.trim())) return "Use no control characters.";
  return "";
}

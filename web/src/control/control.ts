/** This page's side of control: introduces it to the bridge, again after each connection, and carries what its person wants. */
import { computed, signal } from "@preact/signals";
import type { Commands, Outcome } from "../link/commands";
import { remembered, yesOrNo } from "../state/remembered";
import { replay, whyReplay } from "../state/replay";
import { isFreeForYou, newsOf, whyNot, youHold, type ControlMessage } from "./people";

/** Where a tab keeps the token by which the bridge knows it after a reload. A duplicated tab has a copy, and is given another. */
const kTokenKey = "skein.control.token";

const control = signal<ControlMessage | null>(null);

/** Why this page may not command; "" when it may. */
export const why_no_command = computed(() => whyReplay(replay.value) || whyNot(control.value));

/** The same for what takes control if nobody holds it. */
export const why_no_urgent_command = computed(() =>
  isFreeForYou(control.value) ? whyReplay(replay.value) : why_no_command.value,
);

export const person_name = remembered("control.name", "", (stored) =>
  typeof stored === "string" ? stored : null,
);
/** The person only wants to look: control is not taken even when it is free. */
export const view_only = remembered("control.view_only", false, yesOrNo);

export class Control {
  readonly state = control;
  /** When `state` came (performance.now): what it says of time goes on from there. */
  arrival_ms = 0;
  /** What the person has to be told, until it is dismissed. */
  readonly news = signal("");
  private readonly page = randomText();
  private joined = false;
  private withdrawn = false;
  /** What was known when this page was last among the people. */
  private last_known: ControlMessage | null = null;

  constructor(private readonly commands: Commands) {}

  /** The connection is open: says who is here. */
  join(): void {
    // A page that was looking on does not grab control because the bridge was started anew: its holder is to have it back.
    const take = !view_only.value && (!this.joined || youHold(control.value));
    this.joined = true;
    const [name, token] = [person_name.value, readToken()];
    // Kept before the bridge has answered: a page that is reloaded at once is the same person.
    writeToken(token);
    void this.commands.control({
      action: "join",
      page: this.page,
      take,
      token,
      ...(name === "" ? {} : { name }),
    });
  }

  takeMessage(message: ControlMessage, now_ms: number): void {
    const news = newsOf(this.last_known, message);
    if (news !== null && !this.withdrawn) this.news.value = news;
    this.withdrawn = false;
    this.arrival_ms = now_ms;
    if (message.token !== "") writeToken(message.token);
    if (message.you !== 0) this.last_known = message;
    control.value = message;
  }

  take(): Promise<Outcome> {
    return this.commands.control({ action: "take" });
  }
  ask(): Promise<Outcome> {
    return this.commands.control({ action: "ask" });
  }
  withdraw(): Promise<Outcome> {
    this.withdrawn = true;
    return this.commands.control({ action: "withdraw" });
  }
  give(person: number): Promise<Outcome> {
    return this.commands.control({ action: "give", person });
  }
  refuse(person: number): Promise<Outcome> {
    return this.commands.control({ action: "refuse", person });
  }
  release(): Promise<Outcome> {
    return this.commands.control({ action: "release" });
  }
  async rename(name: string): Promise<Outcome> {
    const outcome = await this.commands.control({ action: "rename", name });
    if (outcome.accepted) person_name.value = name;
    return outcome;
  }
  /**
   * Carries out what must be in reach of whoever is there, as Hold: control that nobody holds is taken for it. Who only wants to look
   * may, too: pressing it says otherwise.
   */
  async takenIfFree(command: () => Promise<Outcome>): Promise<Outcome> {
    if (isFreeForYou(control.value)) {
      const outcome = await this.take();
      if (!outcome.accepted) return outcome;
    }
    return command();
  }
  /** Only to look, or not any more. */
  lookOnly(only: boolean): void {
    view_only.value = only;
    if (only && youHold(control.value)) void this.release();
    else if (!only && control.value?.holder === 0) void this.take();
  }
}

function randomText(): string {
  return [...crypto.getRandomValues(new Uint32Array(4))]
    .map((part) => part.toString(16).padStart(8, "0"))
    .join("");
}

function readToken(): string {
  try {
    return sessionStorage.getItem(kTokenKey) ?? randomText();
  } catch {
    return randomText();
  }
}

function writeToken(token: string): void {
  try {
    sessionStorage.setItem(kTokenKey, token);
  } catch {
    // No storage: after a reload the page is somebody else.
  }
}

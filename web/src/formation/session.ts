/** One formation while somebody edits it: every step can be undone, and it knows what is flown meanwhile. */
import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import type { Formation } from "../link/messages";
import { History } from "../state/undo";
import { bodyOf, differences, draftOf, type Draft } from "./draft";

export class EditSession {
  readonly history: History<Draft>;
  readonly draft: ReadonlySignal<Draft>;
  /** What Apply would change, in words; empty: the draft is what is flown. */
  readonly differences: ReadonlySignal<readonly string[]>;
  readonly changed: ReadonlySignal<boolean>;
  /** What somebody else has changed since this draft was begun, in words. */
  readonly overtaken: ReadonlySignal<readonly string[]>;
  /** What was flown when the draft was last in step with it; null: nothing yet. */
  private readonly base = signal<Formation | null>(null);
  private readonly stop: () => void;

  constructor(
    initial: Draft,
    readonly flown: ReadonlySignal<Formation | null>,
  ) {
    this.base.value = flown.peek();
    this.history = new History(initial);
    this.draft = this.history.present;
    this.differences = computed(() =>
      this.flown.value === null ? ["not flown yet"] : differences(bodyOf(this.draft.value), this.flown.value),
    );
    this.changed = computed(() => this.differences.value.length > 0);
    this.overtaken = computed(() => {
      const [flown_now, base] = [this.flown.value, this.base.value];
      if (!this.changed.value || flown_now === null) return [];
      return base === null ? ["the whole formation"] : differences(flown_now, base);
    });
    this.stop = effect(() => {
      this.follow(this.flown.value);
    });
  }

  /** What was flown is flown no more; the draft would make it anew. */
  get removed(): boolean {
    return this.flown.value === null && this.base.value !== null;
  }

  /** Successive changes with one gesture (a drag, a field) are undone at once. */
  change(draft: Draft, label: string, gesture: string | null = null): void {
    this.history.change(draft, label, gesture);
  }

  /** Goes on from what is flown now; can be undone. */
  takeFlown(): void {
    const flown = this.flown.peek();
    if (flown === null) return;
    this.base.value = flown;
    this.change(draftOf(flown), "take what is flown");
  }

  /** Goes on with this draft, though something else is flown. */
  keepMine(): void {
    this.base.value = this.flown.peek();
  }

  end(): void {
    this.stop();
  }

  private follow(flown: Formation | null): void {
    const base = this.base.peek();
    if (flown === null || (base !== null && differences(flown, base).length === 0)) return;
    const body = bodyOf(this.draft.peek());
    const untouched = base !== null && differences(body, base).length === 0;
    if (differences(body, flown).length === 0) this.base.value = flown;
    else if (untouched) {
      this.base.value = flown;
      this.history.reset(draftOf(flown));
    }
  }
}

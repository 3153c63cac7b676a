/** What an editor edits, with every step back and forth. Values are never changed in place. */
import { computed, signal, type ReadonlySignal, type Signal } from "@preact/signals";

interface Step<T> {
  value: T;
  /** What was done to get from `value` to the next one: "move UAV3". */
  label: string;
  /** Successive changes with one gesture are one step. */
  gesture: string | null;
}

const kMostSteps = 500;

export class History<T> {
  readonly present: ReadonlySignal<T>;
  /** What undo and redo would take back or do again; null: nothing. */
  readonly undo_label: ReadonlySignal<string | null>;
  readonly redo_label: ReadonlySignal<string | null>;
  private readonly past = signal<readonly Step<T>[]>([]);
  private readonly future = signal<readonly Step<T>[]>([]);
  private readonly now: Signal<T>;

  constructor(initial: T) {
    this.now = signal(initial);
    this.present = this.now;
    this.undo_label = computed(() => this.past.value.at(-1)?.label ?? null);
    this.redo_label = computed(() => this.future.value.at(-1)?.label ?? null);
  }

  /**
   * Goes on to another value. A drag, or typing in one field, gives its `gesture`: all of it is undone at once, until
   * `endGesture` or another change.
   */
  change(value: T, label: string, gesture: string | null = null): void {
    if (Object.is(value, this.now.peek())) return;
    const last = this.past.peek().at(-1);
    const goes_on = gesture !== null && last?.gesture === gesture && this.future.peek().length === 0;
    if (!goes_on) {
      const step = { value: this.now.peek(), label, gesture };
      this.past.value = [...this.past.peek(), step].slice(-kMostSteps);
      this.future.value = [];
    }
    this.now.value = value;
  }

  endGesture(): void {
    const last = this.past.peek().at(-1);
    if (last === undefined || last.gesture === null) return;
    this.past.value = [...this.past.peek().slice(0, -1), { ...last, gesture: null }];
  }

  undo(): void {
    const step = this.past.peek().at(-1);
    if (step === undefined) return;
    this.past.value = this.past.peek().slice(0, -1);
    this.future.value = [...this.future.peek(), { value: this.now.peek(), label: step.label, gesture: null }];
    this.now.value = step.value;
  }

  redo(): void {
    const step = this.future.peek().at(-1);
    if (step === undefined) return;
    this.future.value = this.future.peek().slice(0, -1);
    this.past.value = [...this.past.peek(), { value: this.now.peek(), label: step.label, gesture: null }];
    this.now.value = step.value;
  }

  /** Begins anew: there is no way back. */
  reset(value: T): void {
    this.past.value = [];
    this.future.value = [];
    this.now.value = value;
  }
}

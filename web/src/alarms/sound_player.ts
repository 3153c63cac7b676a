/** Plays what warns, made of plain tones by WebAudio: no files. */

interface Note {
  /** After the start of the pattern [s]. */
  at_s: number;
  for_s: number;
  frequency_hz: number;
  shape: OscillatorType;
}

const note = (at_s: number, for_s: number, frequency_hz: number, shape: OscillatorType): Note => ({
  at_s,
  for_s,
  frequency_hz,
  shape,
});

/**
 * Told apart by rhythm and pitch, the more urgent the faster and higher, after IEC 60601-1-8's habit: a warning is a quick
 * burst of five, a caution a slower three, an advisory two soft falling notes.
 */
const kPatterns: Readonly<Record<number, readonly Note[]>> = {
  3: [0, 0.16, 0.32, 0.56, 0.72].map((at_s, i) => note(at_s, 0.11, i % 2 === 0 ? 988 : 784, "square")),
  2: [0, 0.28, 0.56].map((at_s) => note(at_s, 0.18, 659, "triangle")),
  1: [note(0, 0.2, 587, "sine"), note(0.24, 0.3, 440, "sine")],
};

/** A square wave is far louder than a sine of the same height. */
const kLoudness: Readonly<Partial<Record<OscillatorType, number>>> = {
  square: 0.25,
  triangle: 0.7,
  sine: 0.8,
};
const kFade_s = 0.015;

export class SoundPlayer {
  private context: AudioContext | null = null;

  /**
   * Browsers are silent until the person has touched the page. To make a context before that only fills the console with
   * warnings, so it is made by the first pattern after it.
   */
  get blocked(): boolean {
    return !navigator.userActivation.hasBeenActive;
  }

  /** @param volume 0..1. Nothing is heard while the browser blocks it. */
  play(severity: number, volume: number): void {
    if (this.blocked || volume <= 0) return;
    this.context ??= new AudioContext();
    const context = this.context;
    if (context.state === "suspended") void context.resume();
    const start_s = context.currentTime + 0.02;
    for (const { at_s, for_s, frequency_hz, shape } of kPatterns[severity] ?? []) {
      const [oscillator, gain] = [context.createOscillator(), context.createGain()];
      oscillator.type = shape;
      oscillator.frequency.value = frequency_hz;
      const [from_s, to_s] = [start_s + at_s, start_s + at_s + for_s];
      const level = volume * (kLoudness[shape] ?? 1);
      // Faded in and out, or it clicks.
      gain.gain.setValueAtTime(0, from_s);
      gain.gain.linearRampToValueAtTime(level, from_s + kFade_s);
      gain.gain.setValueAtTime(level, to_s - kFade_s);
      gain.gain.linearRampToValueAtTime(0, to_s);
      oscillator.connect(gain).connect(context.destination);
      oscillator.start(from_s);
      oscillator.stop(to_s);
    }
  }
}

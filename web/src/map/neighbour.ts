/** The id after (1) or before (-1) the one that is selected, around the end; the first or last without one. Null: there is none. */
export function neighbourOf(ids: readonly number[], selected: number | null, step: 1 | -1): number | null {
  const now = selected === null ? -1 : ids.indexOf(selected);
  const next = now < 0 ? (step > 0 ? 0 : ids.length - 1) : (now + step + ids.length) % ids.length;
  return ids[next] ?? null;
}

/** Ids as people type them: "1-20, 35". */

export type IdRange = { ids: number[] } | { problem: string };

/** Most ids of one text: more is a slip, such as "1-99999999". */
const kMostIds = 100_000;

/** The ids in `text` that are `known`, in rising order; or a sentence that says what is wrong. */
export function parseIdRange(text: string, known: ReadonlySet<number>): IdRange {
  const parts = text.split(/[\s,;]+/).filter(Boolean);
  if (parts.length === 0) return { problem: "Type ids, such as 1-20, 35." };
  const named = new Set<number>();
  for (const part of parts) {
    const match = /^(\d{1,9})(?:[-\u2013](\d{1,9}))?$/.exec(part);
    if (match === null) return { problem: `"${part}" is no id and no range such as 1-20.` };
    const first = Number(match[1]);
    const last = Number(match[2] ?? match[1]);
    if (last < first) return { problem: `"${part}" runs backwards: write ${last}-${first}.` };
    if (last - first >= kMostIds) return { problem: `"${part}" is too long a range.` };
    for (let id = first; id <= last; id += 1) named.add(id);
  }
  const ids = [...named].filter((id) => known.has(id)).sort((a, b) => a - b);
  return ids.length > 0 ? { ids } : { problem: "No UAV has such an id." };
}

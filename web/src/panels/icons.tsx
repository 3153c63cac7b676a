/** Small pictures that say the same as the map's symbols: shape and colour by level. */

export const kLevelNames = ["Clear", "Advisory", "Caution", "Warning"] as const;

/** The warning lamp: a ring, a diamond, a disc, a square. `level` below 0: not known yet. */
export function Lamp({ level }: { level: number }) {
  const name = level < 0 ? "Not judged yet" : (kLevelNames[level] ?? "Unknown");
  return (
    <svg class={`lamp level-${level}`} viewBox="0 0 16 16" role="img" aria-label={name}>
      <title>{name}</title>
      {level < 0 && <path d="M4 8h8" fill="none" />}
      {level === 0 && <circle cx="8" cy="8" r="4.500" fill="none" />}
      {level === 1 && <path d="M8 1L15 8L8 15L1 8Z" />}
      {level === 2 && <circle cx="8" cy="8" r="6.500" />}
      {level === 3 && <path d="M1.500 1.500H14.500V14.500H1.500Z" />}
    </svg>
  );
}

export const kLinkNames = ["up", "late", "lost", "not judged"] as const;

/** A chain: whole, stretched, broken, or only hinted at. */
export function Chain({ state, label }: { state: number; label: string }) {
  return (
    <svg class={`chain link-${state}`} viewBox="0 0 24 12" role="img" aria-label={label}>
      <title>{label}</title>
      {state === 0 && (
        <>
          <path d="M10 2.500H5.500a3.500 3.500 0 0 0 0 7H10M14 2.500H18.500a3.500 3.500 0 0 1 0 7H14" />
          <path d="M8 6H16" />
        </>
      )}
      {state === 1 && (
        <>
          <path d="M9 2.500H5.500a3.500 3.500 0 0 0 0 7H9M15 2.500H18.500a3.500 3.500 0 0 1 0 7H15" />
          <path d="M8.500 6H10M11.500 6H12.500M14 6H15.500" />
        </>
      )}
      {state === 2 && (
        <>
          <path d="M7.500 2.500H5a3.500 3.500 0 0 0 0 7H7.500M16.500 2.500H19a3.500 3.500 0 0 1 0 7H16.500" />
          <path d="M14 0.500L10 11.500" />
        </>
      )}
      {state > 2 && (
        <path
          d="M10 2.500H5.500a3.500 3.500 0 0 0 0 7H10M14 2.500H18.500a3.500 3.500 0 0 1 0 7H14"
          stroke-dasharray="1.500 2"
        />
      )}
    </svg>
  );
}

export function Brand() {
  return (
    <svg class="brand-mark" viewBox="0 0 28 24" aria-hidden="true">
      <path d="M2 18L14 5L26 18" />
      <path class="second" d="M8.500 21L14 15L19.500 21" />
    </svg>
  );
}

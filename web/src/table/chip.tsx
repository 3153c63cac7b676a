import { identityOf } from "../map/colours";

/** A UAV's number in its identity colour, as on the map. */
export function Chip({ id, title }: { id: number; title?: string }) {
  return (
    <span class={`chip identity-${identityOf(id)}`} title={title}>
      {id}
    </span>
  );
}

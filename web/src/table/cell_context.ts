import type { Station } from "../shell/station";

/** What a cell of the table is given besides its row. */
export interface CellContext {
  station: Station;
  /** Of controls in the cell: those of the row that the keyboard is at can be reached by Tab. */
  tab_index: 0 | -1;
}

/** The answer of GET /api/history (cpp/bridge/README.md): views on the received buffer. */
import { kColumns, type ColumnName, type FlightSeries } from "./flight_series";

const kHeaderBytes = 24;
const kVersion = 1;
const kHistoryKind = 3;
const kBytesEach = 4 * kColumns.length + 1;
const kHeard = 1;
const kHasSlot = 2;

export interface HistoryFrame {
  /** When the scenario started [us]. */
  start_utime: number;
  t_s: Float64Array;
  id: Int32Array;
  values: Float32Array;
  flags: Uint8Array;
}

/** Null when it is none that this page knows, or has another length than it says. */
export function decodeHistory(buffer: ArrayBuffer): HistoryFrame | null {
  if (buffer.byteLength < kHeaderBytes) return null;
  const header = new DataView(buffer);
  if (header.getUint8(0) !== kHistoryKind || header.getUint8(1) !== kVersion) return null;
  const ids = header.getUint32(4, true);
  const samples = header.getUint32(16, true);
  const ids_at = kHeaderBytes + 8 * samples;
  const values_at = ids_at + 4 * ids;
  const value_count = ids * kColumns.length * samples;
  if (buffer.byteLength !== values_at + ids * samples * kBytesEach) return null;
  return {
    start_utime: header.getFloat64(8, true),
    t_s: new Float64Array(buffer, kHeaderBytes, samples),
    id: new Int32Array(buffer, ids_at, ids),
    values: new Float32Array(buffer, values_at, value_count),
    flags: new Uint8Array(buffer, values_at + 4 * value_count, ids * samples),
  };
}

/** Adds to `series` what is later than its last sample; what was not known becomes a gap. */
export function appendHistory(series: FlightSeries, frame: HistoryFrame): void {
  const samples = frame.t_s.length;
  const rows = new Map([...frame.id].map((id, row) => [id, row]));
  const column_of = new Map<ColumnName, number>(kColumns.map((name, column) => [name, column]));
  frame.t_s.forEach((t_s, sample) => {
    series.append(t_s, (id, name) => {
      const row = rows.get(id);
      if (row === undefined) return NaN;
      const column = column_of.get(name) ?? 0;
      const value = frame.values[(row * kColumns.length + column) * samples + sample] ?? NaN;
      const flags = frame.flags[row * samples + sample] ?? 0;
      return known(column, value, flags) ? value : NaN;
    });
  });
}

/** The first three columns are motion, the next three errors from the slot, the others -1 where there is none. */
function known(column: number, value: number, flags: number): boolean {
  if (column < 3) return (flags & kHeard) !== 0;
  if (column < 6) return (flags & kHasSlot) !== 0;
  return value >= 0;
}

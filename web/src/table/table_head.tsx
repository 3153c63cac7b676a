import type { Column } from "./columns";
import { kWorstFirst, type Order } from "./row_order";

interface TableHeadProps {
  columns: readonly Column[];
  order: Order;
  setOrder: (order: Order) => void;
}

/** Heads that sort: first the way that matters most, then the other way round, then worst first again. */
export function TableHead({ columns, order, setOrder }: TableHeadProps) {
  return (
    <thead role="rowgroup">
      <tr role="row" aria-rowindex={1}>
        {columns.map((column) => {
          const { sort } = column;
          const sorted = order.key === sort;
          const up = column.rising !== order.reversed;
          return (
            <th
              key={column.id}
              role="columnheader"
              class={column.align}
              aria-sort={sort === null ? undefined : sorted ? (up ? "ascending" : "descending") : "none"}
            >
              {sort === null ? (
                <span class="head-plain" title={column.meaning}>
                  <HeadText column={column} />
                </span>
              ) : (
                <button
                  type="button"
                  title={`${column.meaning}. Press to sort`}
                  onClick={() => {
                    setOrder(
                      !sorted
                        ? { key: sort, reversed: false }
                        : order.reversed
                          ? kWorstFirst
                          : { ...order, reversed: true },
                    );
                  }}
                >
                  <span class="visually-hidden">Sort by</span> <HeadText column={column} />
                  {sorted && (
                    <svg class="sort-mark" viewBox="0 0 8 8" aria-hidden="true">
                      <path d={up ? "M1 6L4 2L7 6" : "M1 2L4 6L7 2"} />
                    </svg>
                  )}
                </button>
              )}
            </th>
          );
        })}
      </tr>
    </thead>
  );
}

function HeadText({ column }: { column: Column }) {
  return (
    <>
      {column.head === "" ? <span class="visually-hidden">{column.name}</span> : <span>{column.head}</span>}
      <small>{column.detail()}</small>
    </>
  );
}

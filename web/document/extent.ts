import type { Project } from "tetrafront";

/** Figures over lists of any length: none of them spreads a list into arguments. */

/** The lowest and the highest coordinate along an axis; infinite and turned round without places. */
export function rangeAlong(
  places: Iterable<{ readonly position: readonly number[] }>,
  axis: number,
): readonly [low: number, high: number] {
  let low = Infinity;
  let high = -Infinity;
  for (const { position: at } of places) {
    const value = at[axis] ?? 0;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

/** The smallest size above 0 of the background grid's nodes; undefined without any. */
export function smallestSize({ background }: Project): number | undefined {
  const smallest = background.nodes.reduce(
    (least, { size }) => (size > 0 && size < least ? size : least),
    Infinity,
  );
  return Number.isFinite(smallest) ? smallest : undefined;
}

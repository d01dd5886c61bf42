import { describe, expect, test } from "vitest";

import type { BackgroundArrays } from "tetrafront";
import { emptyGrid, withNodes } from "../../../wasm/src/project/grid-arrays.js";

const NO_NODES = {
  points: new Float64Array(),
  sizes: new Float64Array(),
  tetrahedra: new Uint32Array(),
} satisfies BackgroundArrays;

function sourcesFrom(first: number, count: number): NonNullable<BackgroundArrays["sources"]> {
  return Array.from({ length: count }, (_, i) => ({
    id: first + i,
    type: "point" as const,
    positions: [[first + i, 0, 0]] as const,
    size: 0.1,
  }));
}

describe("background grids as arrays for the engine", () => {
  test("take any number of sources, appended to the existing ones", () => {
    const few = withNodes(emptyGrid(), { ...NO_NODES, sources: sourcesFrom(1, 3) });
    const all = withNodes(few, { ...NO_NODES, sources: sourcesFrom(4, 50_000) });
    expect(all.sources.type).toHaveLength(50_003);
    for (const i of [0, 2, 3, 50_002]) expect(all.sources.points[9 * i]).toBe(i + 1);
  });
});

import type { RepairChange, RepairOptions, SurfaceInput, SurfaceInspection } from "tetrafront";

/** What the user asks of a repair. */
export type RepairWishes = Pick<RepairOptions, "weld" | "fillHoles">;

/** Largest number of edges of a hole that is filled; the limit of the package. */
const maxHoleEdges = 200;

export const defaultRepair: RepairWishes = { weld: 0, fillHoles: maxHoleEdges };

/** What a repair changes, and its result. */
export interface BodyRepair {
  readonly wishes: RepairWishes;
  readonly changes: readonly RepairChange[];
  /** Inspection of the result. */
  readonly after: SurfaceInspection;
  readonly surface: Pick<SurfaceInput, "points" | "triangles"> & { readonly trianglePatch: Uint32Array };
  /** Whether the last patch holds the triangles of filled holes. */
  readonly hasFilled: boolean;
}

export type RepairKind = RepairChange["kind"];

/** Returns the number of changes of each kind, the most frequent first. */
export function repairCounts(changes: readonly RepairChange[]): readonly (readonly [RepairKind, number])[] {
  const counts = new Map<RepairKind, number>();
  for (const { kind } of changes) counts.set(kind, (counts.get(kind) ?? 0) + 1);
  return [...counts].sort(([, a], [, b]) => b - a);
}

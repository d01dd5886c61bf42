/** Triangles of a surface that was made of another, by the numbers that they have in that one. */
import { nameByPosition, type EntityNamer } from "./project-arrays.js";
import type { SurfaceInput } from "./types.js";

/** In `SurfaceRepair.origin`: a triangle that the given surface did not have. */
export const NO_ORIGIN = 0xffffffff;

/** Names triangles by what they were or are a part of, where the surface tells; those of filled holes were in no other. */
export function surfaceNamer({ origin }: SurfaceInput): EntityNamer {
  if (origin === undefined) return nameByPosition;
  return (kind, index) => {
    if (kind !== "triangle") return nameByPosition(kind, index);
    const given = origin[index] ?? NO_ORIGIN;
    return given === NO_ORIGIN
      ? { kind, index, label: `filled triangle ${index}` }
      : nameByPosition(kind, given);
  };
}

import type { Position } from "./position";

/** A closed chain of drawn lines that a patch can fill. */
export interface DrawnLoop {
  /** Ids of the lines around it. */
  readonly lines: readonly number[];
  /** Ids of the lines around holes within it. */
  readonly holes: readonly (readonly number[])[];
  /** Positions around the loop; the first one is not repeated. */
  readonly polygon: readonly Position[];
  /** Polygons of the holes. */
  readonly holePolygons: readonly (readonly Position[])[];
  /** Unit normal of the loop's plane; null if it lies in none. */
  readonly normal: Position | null;
}

import type { DiagnosticCode, EngineCode, ENGINE_OPTIONS } from "./codes.js";
import type { ReadCode, ReadProblem } from "../formats/read-result.js";

/** Nothing but what the sentence says. */
export type NoData = Readonly<Record<string, never>>;

/** How many findings there are in all, of which a thousand are told one by one unless more are asked for; of a drawing, how many at these entities. */
export interface Counted {
  readonly count: number;
}

/** Where the path, the line or the offset of a read problem is known. */
export type ReadPlace = Pick<ReadProblem, "fileName" | "path" | "line" | "offset">;

/** What comes with each code that has numbers of its own; lengths are in model units. */
export interface DiagnosticNumbers {
  /** The one that cannot be computed with, NaN and infinities too; 0 where all points lie at the origin. */
  readonly "not-finite": Partial<Counted> & { readonly coordinate: number };
  /** The number that nothing has; `count` for surfaces. */
  readonly "index-out-of-range": Partial<Counted> & { readonly index: number };
  /** As many as the line has. */
  readonly "wrong-point-count": { readonly points: number };
  /** As many as the outer loop has, and as its patch's type takes. */
  readonly "wrong-line-count": { readonly lines: number; readonly wanted: number };
  /** The farthest from the plane. */
  readonly "not-planar": { readonly distance: number };
  /** The farthest from the patch. */
  readonly "hole-off-patch": { readonly distance: number };
  /** An option as it reached the engine. */
  readonly "bad-option": { readonly option: (typeof ENGINE_OPTIONS)[number]; readonly given: number };
  /** 1: each pair of patches is told by itself. */
  readonly "patches-meet": Counted;
  /** Places in all, where they were counted. */
  readonly "outside-background-grid": Partial<Counted>;
  /** Expected by the sizes, and the most that are tried: tetrahedra, or triangles where one is named. */
  readonly "too-many-elements": { readonly expected: number; readonly most: number };
  /** As given. */
  readonly "bad-size": { readonly size: number };
  /** As given. */
  readonly "bad-stretching": { readonly stretching: number };
  /** As given, or their defaults. */
  readonly "bad-source": { readonly size: number; readonly distance: number; readonly growth: number };
  /** The smallest size, and the model's largest extent. */
  readonly "size-too-large": { readonly size: number; readonly extent: number };
  /** Open edges. */
  readonly "open-edge": Counted;
  /** Their triangles. */
  readonly "dangling-sheet": Counted;
  /** Places where a part cannot be turned. */
  readonly "inconsistent-orientation": Counted;
  /** Pairs of triangles in all; at least so many where the search `isLeast`, ended early. */
  readonly "self-intersection": Counted & { readonly isLeast?: boolean };
  /** Not of tetrahedra of a background grid. */
  readonly "duplicate-triangle": Partial<Counted>;
  /** Such triangles. */
  readonly "degenerate-triangle": Counted;
  /** Shells that enclose nothing. */
  readonly "zero-volume": Counted;
  /** Pairs of nodes. */
  readonly "coincident-nodes": Counted;
  /** Of a part of a given surface: its triangles that were turned, and all. */
  readonly "reoriented-patch": { readonly turned?: number; readonly triangles?: number };
  /** As the mesh will have them. */
  readonly "nested-bodies": { readonly regions: number; readonly cavities: number };
  /** `isBetweenSpaces`: filling regions (`enclosed`) would take it as a wall. */
  readonly "turned-triangle": Counted & { readonly isBetweenSpaces: boolean };
  /** With edges more than twice as long as wanted; the longest by its wanted length. */
  readonly "coarse-surface": { readonly triangles: number; readonly longest: number };
  /** Left in the front. */
  readonly stalled: { readonly faces: number };
  /** Places where the check failed. */
  readonly "verification-failed": Counted;
  /** The option's name, as the call or the command line knows it; `options` for all of them, `control` for the last argument. */
  readonly "invalid-option": { readonly option: string };
}

/** What comes with a diagnostic of each code. */
export type DiagnosticData = {
  readonly [Code in DiagnosticCode]: Code extends keyof DiagnosticNumbers
    ? DiagnosticNumbers[Code]
    : Code extends ReadCode
      ? ReadPlace
      : NoData;
};

/** The names of numbers, with a `?` behind those that may be missing. */
type NameIn<Data> = {
  [Name in keyof Data & string]-?: object extends Pick<Data, Name> ? `${Name}?` : Name;
}[keyof Data & string];

/**
 * The names of the engine's numbers, in its order; those of `is…` are 1 or 0, and those with a `?`, which come last,
 * may be missing.
 */
export const ENGINE_DATA: Readonly<Partial<Record<EngineCode, readonly string[]>>> = {
  "not-finite": ["coordinate", "count?"],
  "index-out-of-range": ["index", "count?"],
  "wrong-point-count": ["points"],
  "wrong-line-count": ["lines", "wanted"],
  "not-planar": ["distance"],
  "hole-off-patch": ["distance"],
  "bad-option": ["option", "given"],
  "patches-meet": ["count"],
  "outside-background-grid": ["count?"],
  "too-many-elements": ["expected", "most"],
  "bad-size": ["size"],
  "bad-stretching": ["stretching"],
  "bad-source": ["size", "distance", "growth"],
  "size-too-large": ["size", "extent"],
  "open-edge": ["count"],
  "dangling-sheet": ["count"],
  "inconsistent-orientation": ["count"],
  "self-intersection": ["count", "isLeast?"],
  "duplicate-triangle": ["count?"],
  "degenerate-triangle": ["count"],
  "zero-volume": ["count"],
  "coincident-nodes": ["count"],
  "reoriented-patch": ["turned?", "triangles?"],
  "nested-bodies": ["regions", "cavities"],
  "turned-triangle": ["isBetweenSpaces", "count"],
  "coarse-surface": ["triangles", "longest"],
  stalled: ["faces"],
  "verification-failed": ["count"],
} satisfies {
  readonly [Code in Extract<keyof DiagnosticNumbers, EngineCode>]: readonly NameIn<DiagnosticNumbers[Code]>[];
};

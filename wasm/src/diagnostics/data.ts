import type { CheckedOption, EngineCode } from "../generated/constants.js";
import type { DiagnosticCode } from "./codes.js";
import type { ReadCode, ReadError } from "./read-error.js";

/** No data beyond the message. */
export type NoData = Readonly<Record<string, never>>;

/**
 * Total number of such problems; a limited number of them is listed individually. For a drawing, the number at
 * these entities.
 */
export interface Counted {
  readonly count: number;
}

/** Path, line or offset of a read error, if known. */
export type ReadLocation = Pick<ReadError, "fileName" | "path" | "line" | "offset">;

/** Data of each code that has any; lengths are in model units. */
export interface DiagnosticNumbers {
  /** `coordinate`: the invalid coordinate, which may be NaN or infinite; 0 if all points lie at the origin. */
  readonly "not-finite": Partial<Counted> & { readonly coordinate: number };
  /** `index`: the index that does not exist. `count`: for surfaces only. */
  readonly "index-out-of-range": Partial<Counted> & { readonly index: number };
  /** `points`: number of points of the line. */
  readonly "wrong-point-count": { readonly points: number };
  /** `lines`: number of lines of the outer loop. `required`: number that the type of the patch requires. */
  readonly "wrong-line-count": { readonly lines: number; readonly required: number };
  /** `distance`: largest distance from the plane. */
  readonly "not-planar": { readonly distance: number };
  /** `distance`: largest distance from the patch. */
  readonly "hole-off-patch": { readonly distance: number };
  /** `given`: value as it reached the engine. */
  readonly "option-out-of-range": {
    readonly option: CheckedOption;
    readonly given: number;
  };
  /** Always 1: each pair of patches has its own diagnostic. */
  readonly "patches-intersect": Counted;
  /** `count`: number of positions outside, if they were counted. */
  readonly "outside-background-grid": Partial<Counted>;
  /**
   * `expected`: estimated number, of tetrahedra, or of triangles if a triangle is named. `limit`: largest permitted
   * number.
   */
  readonly "too-many-elements": { readonly expected: number; readonly limit: number };
  /** `size`: the invalid size, as given. */
  readonly "size-out-of-range": { readonly size: number };
  /** `stretching`: the invalid stretching, as given. */
  readonly "stretching-out-of-range": { readonly stretching: number };
  /** Values of the source, as given or by default. */
  readonly "source-out-of-range": {
    readonly size: number;
    readonly distance: number;
    readonly growth: number;
  };
  /** `size`: smallest size. `extent`: largest extent of the model. */
  readonly "size-too-large": { readonly size: number; readonly extent: number };
  /** Number of open edges. */
  readonly "open-edge": Counted;
  /** Number of triangles of the sheets. */
  readonly "dangling-sheet": Counted;
  /** Number of edges at which a component cannot be oriented. */
  readonly "inconsistent-orientation": Counted;
  /** Number of pairs of triangles; a lower bound if `isLowerBound`, because the search was ended early. */
  readonly "self-intersection": Counted & { readonly isLowerBound?: boolean };
  /** Without `count` for tetrahedra of a background grid. */
  readonly "duplicate-triangle": Partial<Counted>;
  /** Number of such triangles. */
  readonly "degenerate-triangle": Counted;
  /** Number of shells that enclose nothing. */
  readonly "zero-volume": Counted;
  /** Number of pairs of nodes. */
  readonly "coincident-nodes": Counted;
  /** For a component of a given surface: number of its flipped triangles, and of all its triangles. */
  readonly "reoriented-patch": { readonly flipped?: number; readonly triangles?: number };
  /** Numbers of regions and cavities in the future mesh. */
  readonly "nested-regions": { readonly regions: number; readonly cavities: number };
  /** `isBetweenRegions`: with `innerShells: "regions"`, the triangle would be an interface. */
  readonly "flipped-triangle": Counted & { readonly isBetweenRegions: boolean };
  /**
   * `triangles`: number of triangles with edges above twice the target length. `lengthRatio`: longest edge / target
   * length there.
   */
  readonly "coarse-surface": { readonly triangles: number; readonly lengthRatio: number };
  /** `faces`: number of faces left in the front. */
  readonly stalled: { readonly faces: number };
  /** Number of failed checks. */
  readonly "verification-failed": Counted;
  /** `count`: number of needles and caps. `triangles`: number of all triangles. */
  readonly "needle-surface": Counted & { readonly triangles: number };
  /** `count`: number of elements with a dihedral angle below 10°. `tetrahedra`: number of all elements. */
  readonly "poor-elements": Counted & { readonly tetrahedra: number };
  /** Smallest dihedral angle of the mesh, and the angle of `--require-angle`, in degrees. */
  readonly "required-angle": { readonly angle: number; readonly required: number };
  /**
   * Name of the option in the call or on the command line; `options` for all of them, `control` for the last
   * argument.
   */
  readonly "invalid-option": { readonly option: string };
}

/** Data of a diagnostic, by code. */
export type DiagnosticData = {
  readonly [Code in DiagnosticCode]: Code extends keyof DiagnosticNumbers
    ? DiagnosticNumbers[Code]
    : Code extends ReadCode
      ? ReadLocation
      : NoData;
};

/** Names of the data, with a `?` appended if they are optional. */
type NameIn<Data> = {
  [Name in keyof Data & string]-?: object extends Pick<Data, Name> ? `${Name}?` : Name;
}[keyof Data & string];

/**
 * Names of the engine's values, in its order. Names that begin with "is" are 1 or 0. Names with a `?` come last and
 * are optional.
 */
export const ENGINE_DATA: Readonly<Partial<Record<EngineCode, readonly string[]>>> = {
  "not-finite": ["coordinate", "count?"],
  "index-out-of-range": ["index", "count?"],
  "wrong-point-count": ["points"],
  "wrong-line-count": ["lines", "required"],
  "not-planar": ["distance"],
  "hole-off-patch": ["distance"],
  "option-out-of-range": ["option", "given"],
  "patches-intersect": ["count"],
  "outside-background-grid": ["count?"],
  "too-many-elements": ["expected", "limit"],
  "size-out-of-range": ["size"],
  "stretching-out-of-range": ["stretching"],
  "source-out-of-range": ["size", "distance", "growth"],
  "size-too-large": ["size", "extent"],
  "open-edge": ["count"],
  "dangling-sheet": ["count"],
  "inconsistent-orientation": ["count"],
  "self-intersection": ["count", "isLowerBound?"],
  "duplicate-triangle": ["count?"],
  "degenerate-triangle": ["count"],
  "zero-volume": ["count"],
  "coincident-nodes": ["count"],
  "reoriented-patch": ["flipped?", "triangles?"],
  "nested-regions": ["regions", "cavities"],
  "flipped-triangle": ["isBetweenRegions", "count"],
  "coarse-surface": ["triangles", "lengthRatio"],
  stalled: ["faces"],
  "verification-failed": ["count"],
} satisfies {
  readonly [Code in Extract<keyof DiagnosticNumbers, EngineCode>]: readonly NameIn<DiagnosticNumbers[Code]>[];
};

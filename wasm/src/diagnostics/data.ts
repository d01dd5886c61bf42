import type { EngineNumbers, PoorReason } from "../generated/constants.js";
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
export interface DiagnosticNumbers extends EngineNumbers {
  /** Volumes that the two surfaces enclose, in cubed model units. */
  readonly "changed-volume": { readonly given: number; readonly made: number };
  /** Upper bound of the distance between the surfaces, and the tolerance, in model units. */
  readonly "deviation-above-tolerance": { readonly deviation: number; readonly tolerance: number };
  /** `count`: number of needles and caps. `triangles`: number of all triangles. */
  readonly "needle-surface": Counted & { readonly triangles: number };
  /** `count`: number of pairs. `distance`: that of a weld that joins them, in model units. */
  readonly "near-nodes": Counted & { readonly distance: number };
  /**
   * `count`: number of elements with a dihedral angle below 10°. `tetrahedra`: number of all elements. `angle`: the smallest, in
   * degrees; `reason`: why that element is poor.
   */
  readonly "poor-elements": Counted & {
    readonly tetrahedra: number;
    readonly angle: number;
    readonly reason: PoorReason;
  };
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

/** Errors with which calls of the package reject. */
import { plural } from "../base/plural.js";
import type { CallProgress, ProgressPhase } from "../base/progress.js";
import type { CallFailure } from "../generated/constants.js";
import type { DiagnosticCode } from "./codes.js";
import type { Diagnostic } from "./diagnostic.js";
import { countOf } from "./lines.js";

/** Code of every error: of diagnostics, of reading, and of rejected calls. */
export type ErrorCode = DiagnosticCode | MesherErrorCode;

/** Data of a `MesherError`, by code. */
export interface MesherErrorData {
  /** An argument is invalid; `diagnostics` has at least one entry, with remedies. */
  readonly "invalid-input": { readonly diagnostics: readonly Diagnostic[] };
  /**
   * The signal was aborted before the call or before its result. `reason`, and the `cause` of the error, are
   * the reason of the signal. Every asynchronous function with a signal rejects in this way, except that
   * `meshProject` and `fillSurface` return a result of status `cancelled` with the mesh made so far.
   */
  readonly cancelled: { readonly reason: unknown };
  /** The mesher was disposed of before the call or, if `wasUnderWay`, during it. */
  readonly disposed: { readonly wasUnderWay: boolean };
  /** The engine ran out of memory. The mesher has replaced its engine and remains usable. */
  readonly "out-of-memory": OutOfMemory;
  /**
   * The worker or the engine could not be loaded: from where and why, as far as known, and what to do. If a worker
   * had to be replaced, all pending and later calls reject with this error. The mesher is then disposed of; use
   * `createMesher` to try again. If only the part of the engine for calls other than runs could not be loaded, only
   * these calls reject, and the next one tries again.
   */
  readonly "engine-not-loaded": {
    readonly what: "worker" | "engine";
    readonly reason: string;
    readonly remedy: string;
  };
  /**
   * A bug in Tetrafront; `reason` is the engine's message. The mesher has replaced its engine and remains usable.
   */
  readonly "engine-failed": { readonly reason: string };
}

/** Codes of rejected calls; see `MesherErrorData` for their meaning and data. */
export type MesherErrorCode = keyof MesherErrorData;

/** Where memory ran out, and what would fit. */
export interface OutOfMemory {
  /** Memory that the engine had, in bytes. A browser tab or Node gives it at most 4 GB. */
  readonly bytes: number;
  /** Phase of a run; undefined for other calls. */
  readonly phase: ProgressPhase | undefined;
  /** Number of tetrahedra made so far. */
  readonly tetrahedra: number;
  /** Number of tetrahedra that the sizes ask for; 0 if it was not known yet. */
  readonly expectedTetrahedra: number;
  /** Factor by which elements should be larger to fit into memory; undefined if unknown. */
  readonly sizeFactor: number | undefined;
  /**
   * Approximate number of triangles of a given surface that would fit; undefined if the surface has no more, or
   * there is none.
   */
  readonly fittingTriangles: number | undefined;
}

export type FailureReason = Exclude<CallFailure, "none">;

/** Failure of a call, as the worker reports it. */
export interface EngineFailure {
  readonly reason: FailureReason;
  readonly message: string;
  /** Memory that the engine had, in bytes. */
  readonly bytes: number;
}

/** `MesherError` of one code. */
export interface MesherErrorOf<Code extends MesherErrorCode> extends Error {
  readonly name: "MesherError";
  readonly code: Code;
  readonly data: MesherErrorData[Code];
}

/**
 * Error with which a call rejects; its `code` determines the type of `data`. Runs do not reject because of invalid
 * input, which is a result. Calls whose result has no diagnostics reject with code `invalid-input`.
 *
 *     if (failure instanceof MesherError && failure.code === "out-of-memory") retry(failure.data.sizeFactor);
 */
export type MesherError = { [Code in MesherErrorCode]: MesherErrorOf<Code> }[MesherErrorCode];

/** Class of all `MesherError`s. */
export const MesherError: {
  /** `options`: may contain the cause. */
  new <Code extends MesherErrorCode>(
    code: Code,
    message: string,
    data: MesherErrorData[Code],
    options?: ErrorOptions,
  ): MesherErrorOf<Code>;
  readonly prototype: MesherError;
} = class<Code extends MesherErrorCode> extends Error {
  override readonly name = "MesherError";
  declare readonly data: MesherErrorData[Code];
  constructor(
    readonly code: Code,
    message: string,
    data: MesherErrorData[Code],
    options?: ErrorOptions,
  ) {
    super(message, options);
    // Programs print the enumerable properties of an error that nobody has caught: thousands of diagnostics would hide its message.
    Object.defineProperty(this, "data", { value: data, enumerable: false });
  }
};

/** Throws if there are diagnostics; the message is that of the first, with the number of the others. */
export function refuse(diagnostics: readonly Diagnostic[]): void {
  const [first] = diagnostics;
  if (first === undefined) return;
  const others = countOf(diagnostics, first.severity) - 1;
  const more = others > 0 ? ` (${plural(others, "more problem")}: see data.diagnostics.)` : "";
  throw new MesherError("invalid-input", `${first.message}. ${first.remedy}${more}`, { diagnostics });
}

/** Error for an aborted signal. */
export function cancelledError({ reason }: { readonly reason: unknown }): MesherError {
  const message = "The signal was aborted before the answer came";
  return new MesherError("cancelled", message, { reason }, { cause: reason });
}

export function disposedError(wasUnderWay: boolean): MesherError {
  return new MesherError("disposed", "The mesher was disposed of", { wasUnderWay });
}

/** `reason`: the address of the file, and why it could not be loaded. */
export function notLoadedError(what: "worker" | "engine", reason: string, remedy: string): MesherError {
  const thing = what === "worker" ? "The engine's worker" : "The engine";
  const data = { what, reason, remedy };
  return new MesherError("engine-not-loaded", `${thing} cannot be loaded: ${reason}. ${remedy}`, data);
}

export function crashError(reason: string): MesherError {
  const text = `The engine's worker ended: ${reason}. Another one was started: try again`;
  return new MesherError("engine-failed", text, { reason });
}

/**
 * `progress`: progress of the rejected run, which need not be the call that failed. `triangles`: number of triangles
 * of the surface given to the failed call; 0 without a surface.
 */
export function failureError(
  { reason, message, bytes }: EngineFailure,
  progress: CallProgress | undefined,
  triangles: number,
): MesherError {
  if (reason === "engine-failed") {
    const text = `The engine failed (${message}): please report it with the model`;
    return new MesherError(reason, text, { reason: message });
  }
  const { phase, tetrahedra = 0, expectedTetrahedra = 0 } = progress ?? {};
  const sizeFactor = sizeFactorFor(tetrahedra, expectedTetrahedra);
  const fitting = Math.floor(bytes / BYTES_PER_TRIANGLE);
  const fittingTriangles = sizeFactor === undefined && triangles > fitting ? fitting : undefined;
  const data = { bytes, phase, tetrahedra, expectedTetrahedra, sizeFactor, fittingTriangles };
  return new MesherError(reason, outOfMemoryText(data), data);
}

/** Largest measured memory per triangle of a surface until the first tetrahedron is made, in bytes. */
const BYTES_PER_TRIANGLE = 300;

/**
 * Returns the size factor, because the number of elements is proportional to 1 / size³. The margin is for the
 * stages after the front.
 */
function sizeFactorFor(made: number, expected: number): number | undefined {
  if (made === 0 || expected === 0) return undefined;
  const factor = MARGIN * Math.cbrt(Math.max(1, expected / made));
  return Math.ceil(10 * factor) / 10;
}

/** Safety margin of the size factor: leaves memory for 70 % more elements, since the verification needs more for each than the front. */
const MARGIN = 1.2;

function outOfMemoryText(failure: OutOfMemory): string {
  const { bytes, phase, tetrahedra, expectedTetrahedra } = failure;
  const limit = bytes === 0 ? "" : ` (${Math.round(bytes / 2 ** 20)} MB)`;
  const where = phase === undefined ? "" : ` in the phase "${phase}"`;
  const made =
    expectedTetrahedra === 0
      ? plural(tetrahedra, "tetrahedron")
      : `${tetrahedra} of about ${plural(expectedTetrahedra, "tetrahedron")}`;
  const after = tetrahedra === 0 ? "" : `, after ${made}`;
  return `The engine ran out of memory${limit}${where}${after}. ${remedyFor(failure)}`;
}

function remedyFor({ phase, sizeFactor, fittingTriangles }: OutOfMemory): string {
  if (fittingTriangles !== undefined) {
    const count = Number(fittingTriangles.toPrecision(2));
    return `Use a coarser surface: about ${count} triangles fit, fewer with many tetrahedra between them.`;
  }
  if (phase === undefined) return "Use a smaller surface or mesh.";
  if (sizeFactor === undefined) return "Use larger elements or a coarser surface.";
  return `Use elements at least ${sizeFactor.toFixed(1)} times as large.`;
}

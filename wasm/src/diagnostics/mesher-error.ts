/** Why a call of the package is rejected. */
import { plural } from "../base/plural.js";
import type { Reply } from "../engine/protocol.js";
import type { Diagnostic, Phase, Progress } from "../api/types.js";

/** What comes with each code of a `MesherError`. */
export interface MesherErrorData {
  /** What was given makes no sense; `diagnostics` say what and what to do. At least one. */
  readonly "invalid-input": { readonly diagnostics: readonly Diagnostic[] };
  /**
   * The signal was aborted before the answer came, or before the call; `reason` is the signal's, as is the error's
   * `cause`. Whatever asynchronous function is given a signal rejects so. Runs alone do not: `meshProject` and
   * `fillSurface` give a result of the status `cancelled`, with what exists.
   */
  readonly cancelled: { readonly reason: unknown };
  /** The mesher was disposed of, before the call or, where it `wasUnderWay`, during it. */
  readonly disposed: { readonly wasUnderWay: boolean };
  /** The memory of the engine did not suffice. The mesher has replaced it and goes on. */
  readonly "out-of-memory": OutOfMemory;
  /**
   * The worker or the engine could not be had: from where and why, as far as that is known, and what to do. Where a
   * worker had to be replaced it is every call that was under way, waited or is made afterwards that rejects so. The
   * mesher is disposed of; another try begins with `createMesher`.
   */
  readonly "engine-not-loaded": {
    readonly what: "worker" | "engine";
    readonly reason: string;
    readonly remedy: string;
  };
  /** Our own mistake, in the engine's words. The mesher has replaced its engine and goes on. */
  readonly "engine-failed": { readonly reason: string };
}

/** The codes of calls that are rejected; `MesherErrorData` has what each means, and what comes with it. */
export type MesherErrorCode = keyof MesherErrorData;

/** Where memory ran out, and what would fit. */
export interface OutOfMemory {
  /** What the engine had of the machine's memory. A browser tab or Node gives it at most 4 GB. */
  readonly bytes: number;
  /** Of a run; undefined for other calls. */
  readonly phase: Phase | undefined;
  /** Made until then. */
  readonly tetrahedra: number;
  /** As many as the sizes ask for; 0 where that was not known yet. */
  readonly expectedTetrahedra: number;
  /** Elements so many times as large are likely to fit; undefined where nothing tells. */
  readonly sizeFactor: number | undefined;
  /** About so many triangles of a given surface would fit; undefined where it has no more, or none is given. */
  readonly fittingTriangles: number | undefined;
}

/** A `MesherError` of one code. */
export interface MesherErrorOf<Code extends MesherErrorCode> extends Error {
  readonly name: "MesherError";
  readonly code: Code;
  readonly data: MesherErrorData[Code];
}

/**
 * Why a call was rejected: its `code` tells of what type its `data` are. Runs never are because of bad input, which is
 * a result; calls whose result has no place for diagnostics are, with code `invalid-input`.
 *
 *     if (failure instanceof MesherError && failure.code === "out-of-memory") retry(failure.data.sizeFactor);
 */
export type MesherError = { [Code in MesherErrorCode]: MesherErrorOf<Code> }[MesherErrorCode];

/** The class of all of them. */
export const MesherError: {
  /** `options`: with the cause, if there is one. */
  new <Code extends MesherErrorCode>(
    code: Code,
    message: string,
    data: MesherErrorData[Code],
    options?: ErrorOptions,
  ): MesherErrorOf<Code>;
  readonly prototype: MesherError;
} = class<Code extends MesherErrorCode> extends Error {
  override readonly name = "MesherError";
  constructor(
    readonly code: Code,
    message: string,
    readonly data: MesherErrorData[Code],
    options?: ErrorOptions,
  ) {
    super(message, options);
  }
};

/** Throws where there is anything in the list; the message is that of the first. */
export function refuse(diagnostics: readonly Diagnostic[]): void {
  const [first] = diagnostics;
  if (first === undefined) return;
  throw new MesherError("invalid-input", `${first.message}. ${first.remedy}`, { diagnostics });
}

/** Of a signal that is aborted. */
export function cancelledError({ reason }: { readonly reason: unknown }): MesherError {
  const message = "The signal was aborted before the answer came";
  return new MesherError("cancelled", message, { reason }, { cause: reason });
}

export function disposedError(wasUnderWay: boolean): MesherError {
  return new MesherError("disposed", "The mesher was disposed of", { wasUnderWay });
}

/** `reason`: where it was looked for and why it is not there. */
export function notLoadedError(what: "worker" | "engine", reason: string, remedy: string): MesherError {
  const thing = what === "worker" ? "The engine's worker" : "The engine";
  const data = { what, reason, remedy };
  return new MesherError("engine-not-loaded", `${thing} cannot be loaded: ${reason}. ${remedy}`, data);
}

export function crashError(reason: string): MesherError {
  return new MesherError("engine-failed", `The engine's worker ended: ${reason}`, { reason });
}

/**
 * `progress`: of the run that is rejected, which need not be what failed. `triangles`: of the surface that was given to
 * what failed, 0 if none was.
 */
export function failureError(
  { reason, message, bytes }: Extract<Reply, { kind: "failure" }>,
  progress: Progress | undefined,
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
  const figures = { bytes, phase, tetrahedra, expectedTetrahedra, sizeFactor, fittingTriangles };
  return new MesherError(reason, outOfMemoryText(figures), figures);
}

/** What the engine takes for each triangle of a surface until the first tetrahedron is made, as measured, at most. */
const BYTES_PER_TRIANGLE = 300;

/** The number of elements falls with the cube of their size. Room is left for what follows the front. */
function sizeFactorFor(made: number, expected: number): number | undefined {
  if (made === 0 || expected === 0) return undefined;
  const factor = ROOM * Math.cbrt(Math.max(1, expected / made));
  return Math.ceil(10 * factor) / 10;
}

/** As a factor of the size: the memory of a third more elements. */
const ROOM = 1.1;

function outOfMemoryText(figures: OutOfMemory): string {
  const { bytes, phase, tetrahedra, expectedTetrahedra } = figures;
  const had = bytes === 0 ? "" : ` of ${Math.round(bytes / 2 ** 20)} MB`;
  const where = phase === undefined ? "" : ` in the phase "${phase}"`;
  const made = tetrahedra === 0 ? "" : `, with ${plural(tetrahedra, "tetrahedron")} made`;
  const expected = made === "" || expectedTetrahedra === 0 ? "" : ` of about ${expectedTetrahedra} asked for`;
  const remedy = remedyFor(figures);
  return `The engine's memory${had} did not suffice: it ran out${where}${made}${expected}. ${remedy}`;
}

function remedyFor({ phase, sizeFactor, fittingTriangles }: OutOfMemory): string {
  if (fittingTriangles !== undefined) {
    const count = Number(fittingTriangles.toPrecision(2));
    return `Give a coarser surface: about ${count} triangles fit, fewer with many tetrahedra between them.`;
  }
  if (phase === undefined) return "Give a smaller surface or mesh.";
  if (sizeFactor === undefined) return "Ask for larger elements, or give a coarser surface.";
  return `Ask for elements ${sizeFactor.toFixed(1)} times as large, or more.`;
}

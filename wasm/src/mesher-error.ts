/** Why a call of the mesher is rejected. */
import type { Reply } from "./protocol.js";
import type { Diagnostic, Phase, Progress } from "./types.js";

/**
 * - `invalid-input`: what was given makes no sense; `diagnostics` say what and what to do.
 * - `cancelled`: the signal was aborted before the answer came. Runs do not reject so; they return a
 *   result of that status with what exists.
 * - `disposed`: the mesher was disposed of, before the call or during it.
 * - `out-of-memory`: the memory of the engine did not suffice; `memory` has the figures. The mesher has
 *   replaced it and goes on.
 * - `engine-not-loaded`: the worker or the engine could not be had; the message tells from where and why, as far as
 *   that is known, and what to do. Where a worker had to be replaced it is every call that was under way, waited or is
 *   made afterwards that rejects so. The mesher is disposed of; another try begins with `createMesher`.
 * - `engine-failed`: our own mistake. The mesher has replaced its engine and goes on.
 */
export type MesherErrorCode =
  "invalid-input" | "cancelled" | "disposed" | "out-of-memory" | "engine-not-loaded" | "engine-failed";

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
}

/**
 * Why a call was rejected. Runs never are because of bad input, which is a result; calls whose result
 * has no place for diagnostics are, with code `invalid-input` and the diagnostics here.
 */
export class MesherError extends Error {
  override readonly name = "MesherError";
  constructor(
    readonly code: MesherErrorCode,
    message: string,
    readonly diagnostics: readonly Diagnostic[] = [],
    /** With code `out-of-memory`. */
    readonly memory: OutOfMemory | undefined = undefined,
  ) {
    super(message);
  }
}

/** Throws where there is anything in the list; the message is that of the first. */
export function refuse(wrong: readonly Diagnostic[]): void {
  const [first] = wrong;
  if (first === undefined) return;
  throw new MesherError("invalid-input", `${first.message}. ${first.remedy}`, wrong);
}

export function cancelledError(): MesherError {
  return new MesherError("cancelled", "The signal was aborted before the answer came");
}

export function disposedError(): MesherError {
  return new MesherError("disposed", "The mesher was disposed of");
}

/** `reason`: where it was looked for and why it is not there. */
export function notLoadedError(what: "worker" | "engine", reason: string, remedy: string): MesherError {
  return new MesherError(
    "engine-not-loaded",
    `The engine${what === "worker" ? "'s worker" : ""} cannot be loaded: ${reason}. ${remedy}`,
  );
}

export function crashError(message: string): MesherError {
  return new MesherError("engine-failed", `The engine's worker ended: ${message}`);
}

/** `progress`: of the run that is rejected, which need not be what failed. */
export function failureError(
  { reason, message, bytes }: Extract<Reply, { kind: "failure" }>,
  progress: Progress | undefined,
): MesherError {
  if (reason === "engine-failed") {
    return new MesherError(reason, `The engine failed (${message}): please report it with the model`);
  }
  const { phase, tetrahedra = 0, expectedTetrahedra = 0 } = progress ?? {};
  const sizeFactor = sizeFactorFor(tetrahedra, expectedTetrahedra);
  const figures = { bytes, phase, tetrahedra, expectedTetrahedra, sizeFactor };
  return new MesherError(reason, outOfMemoryText(figures), [], figures);
}

/** The number of elements falls with the cube of their size. Room is left for what follows the front. */
function sizeFactorFor(made: number, expected: number): number | undefined {
  if (made === 0 || expected === 0) return undefined;
  const factor = ROOM * Math.cbrt(Math.max(1, expected / made));
  return Math.ceil(10 * factor) / 10;
}

/** As a factor of the size: the memory of a third more elements. */
const ROOM = 1.1;

function outOfMemoryText({ bytes, phase, tetrahedra, expectedTetrahedra, sizeFactor }: OutOfMemory): string {
  const had = bytes === 0 ? "" : ` of ${Math.round(bytes / 2 ** 20)} MB`;
  const where = phase === undefined ? "" : ` in the phase "${phase}"`;
  const made = tetrahedra === 0 ? "" : `, with ${tetrahedra} tetrahedra made`;
  const expected = made === "" || expectedTetrahedra === 0 ? "" : ` of about ${expectedTetrahedra} asked for`;
  const remedy = remedyFor(phase, sizeFactor);
  return `The engine's memory${had} did not suffice: it ran out${where}${made}${expected}. ${remedy}`;
}

function remedyFor(phase: Phase | undefined, sizeFactor: number | undefined): string {
  if (phase === undefined) return "Give a smaller surface or mesh.";
  if (sizeFactor === undefined) return "Ask for larger elements, or give a coarser surface.";
  return `Ask for elements ${sizeFactor.toFixed(1)} times as large, or more.`;
}

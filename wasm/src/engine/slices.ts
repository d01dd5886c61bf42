/**
 * Advances a run in slices. Calls are short for two reasons: between them the worker receives a cancel message
 * without shared memory; and V8 never replaces the code of a running WebAssembly function, so that one long call
 * would stay in slow baseline code.
 */
import type { CallProgress } from "../base/progress.js";
import {
  CALL_FAILURES,
  ENGINE_STATUSES,
  type CallFailure,
  type Phase,
  PHASES,
} from "../generated/constants.js";
import type { MeshStatus } from "../mesh/report.js";
import type { EngineMesh } from "./engine-mesh.js";
import type { EngineRun, EngineTool } from "./loader.js";
import type { RunClock } from "./run-clock.js";
import type { TilePool } from "./tile-pool.js";

/**
 * Longest time without receiving messages, in milliseconds: a fraction of the time in which a cancel must take
 * effect.
 */
const SLICE_MS = 12;
/**
 * Work per call: about half a millisecond while the front advances. A budget that grew during a cheap phase would
 * be far too large at the start of the next one.
 */
const BUDGET = 256;
/** Shortest time between two progress reports, in milliseconds. */
const PROGRESS_MS = 100;

/** Shortest time between two snapshots of the front, in milliseconds: at most four a second. */
const FRONT_MS = 250;
/** A snapshot waits this many times as long as the last one took, so that snapshots take at most 2 % of the run. */
const FRONT_REST = 50;

export interface SliceControl {
  readonly isCancelled: () => boolean;
  readonly onProgress: (progress: CallProgress) => void;
  readonly letRequestsIn: () => Promise<void>;
}

export interface ToolSliceControl extends SliceControl {
  /** Returns whether to end the work early with what has been made so far. */
  readonly isStopped: () => boolean;
}

export interface RunSliceControl extends SliceControl {
  /**
   * Receives the front from time to time while it advances, x y z of three corners per face; undefined for no
   * snapshots.
   */
  readonly onFront: ((corners: Float64Array) => void) | undefined;
  /** Receives the events that the run has recorded since the last call, after each slice; undefined if it records none. */
  readonly onTrace: ((events: Uint8Array) => void) | undefined;
  /** Receives the mesh once while it is optimized or verified; undefined for never. */
  readonly onUnoptimized: ((mesh: EngineMesh) => void) | undefined;
  /** Workers that optimize tiles of the mesh too; undefined for none. */
  readonly tiles: TilePool | undefined;
}

export function failureOf(work: { failure(): number }): CallFailure {
  return CALL_FAILURES[work.failure()] ?? "engine-failed";
}

/** Runs until the end or until it is cancelled. Always reports the last progress. */
export async function runInSlices(
  run: EngineRun,
  clock: RunClock,
  control: RunSliceControl,
): Promise<MeshStatus> {
  const snapshots = control.onFront && new FrontSnapshots(run, control.onFront);
  const unoptimized = control.onUnoptimized && new UnoptimizedSnapshot(run, control.onUnoptimized);
  let reportedAt = 0;
  let reached = 0;
  for (;;) {
    const status = advanceFor(SLICE_MS, run, clock, control.tiles);
    const events = control.onTrace && run.takeTrace?.();
    if (events !== undefined && events.length > 0) control.onTrace?.(events);
    // A failed run has no progress to report.
    if (status !== undefined && failureOf(run) !== "none") return status;
    const now = performance.now();
    if (status !== undefined || now - reportedAt >= PROGRESS_MS) {
      reportedAt = now;
      const progress = progressOf(run, clock);
      // An estimate may turn out too high; a progress bar must not move back.
      reached = Math.max(reached, progress.fraction);
      control.onProgress({ ...progress, fraction: reached });
    }
    if (status !== undefined) return status;
    const phase = phaseOf(run);
    if (phase === "volume") snapshots?.takeIfDue(now);
    else if (phase === "optimize" || phase === "verify") unoptimized?.takeIfDue(now);
    if (control.tiles !== undefined) await shareTiles(control.tiles, phase, clock);
    await control.letRequestsIn();
    if (control.isCancelled()) run.cancel();
  }
}

/** Lends tiles while the mesh is optimized; waits if the run can only wait for them. */
async function shareTiles(tiles: TilePool, phase: Phase, clock: RunClock): Promise<void> {
  if (phase === "verify") return tiles.close();
  if (phase !== "optimize") return;
  tiles.lend();
  if (!tiles.isAwaited()) return;
  const began = performance.now();
  await tiles.changed();
  clock.book(phase, performance.now() - began);
}

/** Sends copies of the front, at intervals that grow with the time that a copy takes. */
class FrontSnapshots {
  readonly #run: EngineRun;
  readonly #onFront: (corners: Float64Array) => void;
  #dueAt = performance.now() + FRONT_MS;

  constructor(run: EngineRun, onFront: (corners: Float64Array) => void) {
    this.#run = run;
    this.#onFront = onFront;
  }

  takeIfDue(now: number): void {
    if (now < this.#dueAt) return;
    const corners = this.#run.front();
    // The front closes before the phase ends.
    if (corners.length > 0) this.#onFront(corners);
    const end = performance.now();
    this.#dueAt = end + Math.max(FRONT_MS, FRONT_REST * (end - now));
  }
}

/** Sends one copy of the mesh, a while after the front has closed: a short optimization needs none. */
class UnoptimizedSnapshot {
  readonly #run: EngineRun;
  readonly #onUnoptimized: (mesh: EngineMesh) => void;
  #dueAt: number | undefined;

  constructor(run: EngineRun, onUnoptimized: (mesh: EngineMesh) => void) {
    this.#run = run;
    this.#onUnoptimized = onUnoptimized;
  }

  /** Call it after the front has closed. */
  takeIfDue(now: number): void {
    this.#dueAt ??= now + FRONT_MS;
    if (now < this.#dueAt) return;
    this.#dueAt = Infinity;
    this.#onUnoptimized({ surface: this.#run.surface(), volume: this.#run.volume() });
  }
}

/** Works on a question until it is answered or stopped; returns false if it was cancelled first. */
export async function workInSlices(tool: EngineTool, control: ToolSliceControl): Promise<boolean> {
  const began = performance.now();
  let reportedAt = began;
  for (;;) {
    if (control.isStopped()) tool.stop();
    const deadline = performance.now() + SLICE_MS;
    let isFinished: boolean;
    do isFinished = tool.advance(BUDGET);
    while (!isFinished && performance.now() < deadline);
    const now = performance.now();
    if (isFinished || now - reportedAt >= PROGRESS_MS) {
      reportedAt = now;
      const counts = {
        nodes: 0,
        triangles: 0,
        tetrahedra: 0,
        frontFaces: 0,
        expectedTetrahedra: 0,
        exactFillFraction: 0,
      };
      const elapsedSeconds = (now - began) / 1000;
      control.onProgress({ phase: "check", fraction: tool.fraction(), ...counts, elapsedSeconds });
    }
    if (isFinished) return true;
    await control.letRequestsIn();
    if (control.isCancelled()) return false;
  }
}

/** Runs one slice of many short calls. Returns undefined while the run continues. Ends early if it can only wait for tiles. */
function advanceFor(
  milliseconds: number,
  run: EngineRun,
  clock: RunClock,
  tiles: TilePool | undefined,
): MeshStatus | undefined {
  const deadline = performance.now() + milliseconds;
  for (let began = performance.now(); began < deadline && tiles?.isAwaited() !== true;) {
    const phase = phaseOf(run);
    const status = ENGINE_STATUSES[run.advance(BUDGET)] ?? "invalid-input";
    const ended = performance.now();
    clock.book(phase, ended - began);
    if (status !== "running") return status;
    began = ended;
  }
  return undefined;
}

function phaseOf(run: EngineRun): Phase {
  return PHASES[run.phase()] ?? "check";
}

function progressOf(run: EngineRun, clock: RunClock): CallProgress {
  return { ...run.progress(), phase: phaseOf(run), elapsedSeconds: clock.elapsedSeconds() };
}

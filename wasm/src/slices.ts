/**
 * Advances a run in slices. Short calls for two reasons: between them the worker hears a cancel
 * without shared memory, and V8 never replaces a WebAssembly frame that is running, so that one
 * long call would stay in slow baseline code.
 */
import type { EngineRun } from "./engine.js";
import { PHASES, type RunClock } from "./run-clock.js";
import type { MeshStatus, Phase, Progress } from "./types.js";

/** What one slice should last, in milliseconds: a fifth of what a cancel may take at most. */
const SLICE_MS = 15;
/** The first slice is short: nothing is known yet about the machine or the model. */
const FIRST_BUDGET = 64;
const MAX_BUDGET = 1 << 20;
/** A slice that was far too short or too long changes the next one by no more than this factor. */
const MAX_CHANGE = 4;
/** At most ten reports a second. */
const PROGRESS_MS = 100;

/** The engine's statuses by number; undefined while running (cpp/include/tetrafront/status.h). */
const STATUSES: readonly (MeshStatus | undefined)[] = [
  undefined,
  "done",
  "stalled",
  "cancelled",
  "invalid-input",
];

export interface SliceControl {
  readonly isCancelled: () => boolean;
  readonly onProgress: (progress: Progress) => void;
  readonly letRequestsIn: () => Promise<void>;
}

/** Runs to the end, or to the cancel. The last progress is always reported. */
export async function runInSlices(
  run: EngineRun,
  clock: RunClock,
  control: SliceControl,
): Promise<MeshStatus> {
  let budget = FIRST_BUDGET;
  let reportedAt = 0;
  for (;;) {
    const began = performance.now();
    const phase = phaseOf(run);
    const status = STATUSES[run.advance(budget)];
    const ended = performance.now();
    clock.book(phase, ended - began);
    if (status !== undefined) {
      control.onProgress(progressOf(run, clock));
      return status;
    }
    budget = nextBudget(budget, ended - began);
    if (ended - reportedAt >= PROGRESS_MS) {
      reportedAt = ended;
      control.onProgress(progressOf(run, clock));
    }
    await control.letRequestsIn();
    if (control.isCancelled()) run.cancel();
  }
}

function nextBudget(budget: number, milliseconds: number): number {
  const change = Math.min(MAX_CHANGE, Math.max(1 / MAX_CHANGE, SLICE_MS / Math.max(milliseconds, 0.01)));
  return Math.min(MAX_BUDGET, Math.max(1, Math.round(budget * change)));
}

function phaseOf(run: EngineRun): Phase {
  return PHASES[run.progress().phase] ?? "check";
}

function progressOf(run: EngineRun, clock: RunClock): Progress {
  const { fraction, points, triangles, tetrahedra, frontFaces } = run.progress();
  const elapsedSeconds = clock.elapsedSeconds();
  return { phase: phaseOf(run), fraction, points, triangles, tetrahedra, frontFaces, elapsedSeconds };
}

import type { EdgeRefusal, Refusal, SurfaceTrace, Trace } from "tetrafront/trace";
import { refusals } from "./refusals";
import type { Condition } from "./condition";
import { holds } from "./condition-test";
import { firstState, surfaceState } from "./phases";

/** Steps at which playing can pause, and to which one can jump. */
export const stopKinds = ["postponed", ...refusals, "recovery", "new-node", "line", "patch"] as const;
export type StopKind = (typeof stopKinds)[number];

/** `TraceSteps.outcomes` of a step whose face was postponed; those of recovery are larger. */
const postponedOutcome = 1;

/** A kind of step, or a condition that steps can meet. */
export type Stop = StopKind | Condition;

/**
 * Returns the nearest step of a kind after or before a step, but not after `last`; null if there is none. O(steps between).
 */
export function nextStop(
  trace: Trace,
  step: number,
  direction: 1 | -1,
  stop: Stop,
  last = trace.stepCount,
): number | null {
  for (let i = step + direction; i > firstState(trace) && i <= last; i += direction)
    if (isStop(trace, i, stop)) return i;
  return null;
}

function isStop(trace: Trace, step: number, stop: Stop): boolean {
  return typeof stop === "string" ? isOfKind(trace, step, stop) : holds(trace, step, stop);
}

function isOfKind(trace: Trace, step: number, kind: StopKind): boolean {
  const state = surfaceState(trace, step);
  if (state !== null) return trace.surface !== null && isSurfaceStepOfKind(trace.surface, state, kind);
  return step > 0 && isVolumeStepOfKind(trace, step, kind);
}

/** Lines count where they are divided, patches where their front begins. */
function isSurfaceStepOfKind(surface: SurfaceTrace, step: number, kind: StopKind): boolean {
  switch (kind) {
    case "line":
      return surface.kindAt(step) === "divided";
    case "patch":
    case "postponed":
      return surface.kindAt(step) === kind;
    case "recovery":
      return false;
    case "new-node":
      return surface.makesNode(step);
    default:
      return surface.refusalsAt(step).includes(kind);
  }
}

function isVolumeStepOfKind({ steps }: Trace, step: number, kind: StopKind): boolean {
  switch (kind) {
    case "postponed":
      return steps.outcomes[step] === postponedOutcome;
    case "recovery":
      return (steps.outcomes[step] ?? 0) > postponedOutcome;
    case "new-node":
      return (steps.nodesMade[step] ?? 0) > (steps.nodesMade[step - 1] ?? 0);
    case "line":
    case "patch":
      return false;
    default:
      return firstRefused(steps, step, kind) !== null;
  }
}

/** Returns the rank of the first candidate of a step that was refused for a reason; null if there is none. */
function firstRefused(steps: Trace["steps"], step: number, reason: Refusal): number | null {
  const begin = steps.firstCandidates[step] ?? 0;
  const verdicts = steps.candidateVerdicts.subarray(begin, steps.firstCandidates[step + 1]);
  const rank = verdicts.indexOf(refusals.indexOf(reason));
  return rank < 0 ? null : rank;
}

/** Returns the rank of the candidate because of which a step is of a kind; null if it is so as a whole. */
export function refusedIn(trace: Trace, step: number, stop: Stop): number | null {
  const sought = typeof stop === "string" ? stop : reasonIn(stop);
  const reason = refusals.find((refusal) => refusal === sought);
  if (!reason) return null;
  const state = surfaceState(trace, step);
  if (state === null) return firstRefused(trace.steps, step, reason);
  const rank = trace.surface?.refusalsAt(state).indexOf(reason) ?? -1;
  return rank < 0 ? null : rank;
}

/** Returns the first reason of a refusal that a condition names. */
function reasonIn(condition: Condition): EdgeRefusal | null {
  if (condition.kind === "refused") return condition.reason;
  const parts = condition.kind === "all" || condition.kind === "any" ? condition.parts : [];
  return parts.map(reasonIn).find((reason) => reason !== null) ?? null;
}

/** Returns the kinds of steps that a trace has, in the order of `stopKinds`. O(steps + candidates), without decoding a step. */
export function stopKindsOf(trace: Trace): readonly StopKind[] {
  const { refused, postponed, changes, patches } = trace.summary();
  const ofRefusals = refusals.map((kind) => [kind, refused[kind] + (patches?.refused[kind] ?? 0)] as const);
  const counts = new Map<StopKind, number>([
    ...ofRefusals,
    ["postponed", postponed + (patches?.postponed ?? 0)],
    ["recovery", Object.values(changes).reduce((sum, count) => sum + count, 0)],
  ]);
  // Steps of the other kinds come early, if there are any.
  const isFound = (kind: StopKind): boolean => nextStop(trace, firstState(trace), 1, kind) !== null;
  return stopKinds.filter((kind) => (counts.has(kind) ? counts.get(kind) !== 0 : isFound(kind)));
}

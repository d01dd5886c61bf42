/**
 * The phases of a trace on one scale: steps of lines and patches have negative numbers, so that those of the volume do not
 * depend on them. State 0 is the first front of the volume; the state before it is that after all patches.
 */
import type { Trace } from "tetrafront/trace";

export type Phase = "lines" | "patches" | "volume";

/** Returns the number of the first state: 0 without lines and patches, else negative. */
export function firstState({ surface }: Trace): number {
  return surface === null ? 0 : -1 - surface.stepCount;
}

/** Returns the state of the lines and patches that a number stands for, from 0; null for one of the volume. */
export function surfaceState(trace: Trace, step: number): number | null {
  return step < 0 ? step - firstState(trace) : null;
}

/** A phase, and its first and last state. */
export interface PhaseRange {
  readonly phase: Phase;
  readonly from: number;
  readonly to: number;
}

/** Returns the phases of a trace in their order. Each state belongs to one of them. */
export function phasesOf(trace: Trace): readonly PhaseRange[] {
  const volume = { phase: "volume", from: 0, to: trace.stepCount } as const;
  if (trace.surface === null) return [volume];
  const first = firstState(trace);
  const lastOfLines = first + trace.surface.lastLineStep;
  const lines = { phase: "lines", from: first, to: lastOfLines } as const;
  const patches = { phase: "patches", from: lastOfLines + 1, to: -1 } as const;
  return patches.from <= patches.to ? [lines, patches, volume] : [lines, volume];
}

/** Returns the phase to which a state belongs. */
export function phaseAt(trace: Trace, step: number): PhaseRange {
  const found = phasesOf(trace).find(({ to }) => step <= to);
  return found ?? { phase: "volume", from: 0, to: trace.stepCount };
}

/** Returns the first state of the phase of a state; if it is that already, of the phase before. */
export function phaseStart(trace: Trace, step: number): number {
  const { from } = phaseAt(trace, step);
  return step > from ? from : phaseAt(trace, Math.max(firstState(trace), from - 1)).from;
}

/** Returns the last state of the phase of a state; if it is that already, of the phase after. */
export function phaseEnd(trace: Trace, step: number): number {
  const { to } = phaseAt(trace, step);
  return step < to ? to : phaseAt(trace, Math.min(trace.stepCount, to + 1)).to;
}

/** Returns the number of active faces of the front in a state; in a patch, of active edges. */
export function frontSizeAt(trace: Trace, step: number): number {
  const state = surfaceState(trace, step);
  return state === null ? (trace.steps.frontSizes[step] ?? 0) : (trace.surface?.frontSizeAt(state) ?? 0);
}

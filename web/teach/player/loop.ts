/** The steps that the player repeats: a range within one phase, numbered as the counter of the player does. */
import type { Trace } from "tetrafront/trace";
import { phaseAt } from "./phases";

/** First and last state that are repeated. */
export interface Loop {
  readonly from: number;
  readonly to: number;
}

export type LoopEnd = keyof Loop;

/** Half the number of steps that a new loop repeats. */
const loopReach = 50;

/** Returns the loop around a state, within its phase. */
export function loopAround(trace: Trace, state: number): Loop {
  const { from, to } = phaseAt(trace, state);
  return { from: Math.max(from, state - loopReach), to: Math.min(to, state + loopReach) };
}

/** Returns the smallest and the largest number that an end can have, as the counter shows them. */
export function loopLimits(trace: Trace, { from: state }: Loop, end: LoopEnd): readonly [number, number] {
  const { from, to } = phaseAt(trace, state);
  return end === "from" ? [0, Math.max(0, to - from - 1)] : [Math.min(1, to - from), to - from];
}

/** Returns the ends of a loop as the counter shows them. */
export function shownLoop(trace: Trace, loop: Loop): Loop {
  const { from } = phaseAt(trace, loop.from);
  return { from: loop.from - from, to: loop.to - from };
}

/** Returns a loop with one end at a number within its limits. The other end gives way, so that they differ. */
export function withLoopEnd(trace: Trace, loop: Loop, end: LoopEnd, shown: number): Loop {
  const at = phaseAt(trace, loop.from).from + shown;
  return end === "from"
    ? { from: at, to: Math.max(loop.to, at + 1) }
    : { from: Math.min(loop.from, at - 1), to: at };
}

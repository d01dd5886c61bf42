import type { DrawnLoop } from "./drawn-loop";

/**
 * Returns the loop that a patch at each line would fill. Around a hole, it is the loop outside: with a patch within the hole
 * too, its lines would still be open. O(lines).
 */
export function loopsToFill(loops: readonly DrawnLoop[]): ReadonlyMap<number, DrawnLoop> {
  const bounding = new Map<number, DrawnLoop>();
  const outside = new Map<number, DrawnLoop>();
  const add = (among: Map<number, DrawnLoop>, step: number, loop: DrawnLoop): void => {
    const line = Math.abs(step);
    if (!among.has(line)) among.set(line, loop);
  };
  for (const loop of loops) {
    for (const step of loop.lines) add(bounding, step, loop);
    for (const step of loop.holes.flat()) add(outside, step, loop);
  }
  const depths = depthsOf(loops, outside);
  const filled = new Map(bounding);
  for (const [line, loop] of outside) {
    if ((depths.get(loop) ?? 0) % 2 === 0) filled.set(line, loop);
  }
  return filled;
}

/** Returns within how many of the loops each loop lies; `outside`: the loop around each line of a hole. */
function depthsOf(
  loops: readonly DrawnLoop[],
  outside: ReadonlyMap<number, DrawnLoop>,
): ReadonlyMap<DrawnLoop, number> {
  const depths = new Map<DrawnLoop, number>();
  for (const loop of loops) {
    // From the loop to one whose depth is known, or outermost; not by recursion: loops may be nested deeply.
    const chain = new Set<DrawnLoop>();
    let around: DrawnLoop | undefined = loop;
    while (around && !depths.has(around) && !chain.has(around)) {
      chain.add(around);
      around = outside.get(Math.abs(around.lines[0] ?? 0));
    }
    let depth = around ? (depths.get(around) ?? 0) : -1;
    for (const one of [...chain].toReversed()) depths.set(one, ++depth);
  }
  return depths;
}

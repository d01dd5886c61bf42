/** Lines, patches and the volume on one scale, and the jumps between their steps. */
import { createMesher } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, test } from "vitest";
import { recordSurface } from "../../support/recorded-models";
import {
  firstState,
  frontSizeAt,
  phaseAt,
  phaseEnd,
  phasesOf,
  phaseStart,
  surfaceState,
} from "../../../web/teach/player/phases";
import { knownCandidate } from "../../../web/teach/player/shared-front";
import { nextStop, refusedIn, stopKinds, stopKindsOf } from "../../../web/teach/player/stops";
import { surfaceScene } from "../../../web/teach/player/surface-scene";
import { planePaths } from "../../../web/teach/player/plane-drawing";
import { examineCandidate } from "../../../web/teach/player/planar-lens";

let trace: Trace;
beforeAll(async () => {
  const mesher = await createMesher();
  ({ trace } = await recordSurface(mesher, "unit-cube"));
  mesher.dispose();
});

const surfaceOf = () => {
  if (trace.surface === null) throw new Error("the trace has no lines and patches");
  return trace.surface;
};

test("every state belongs to one phase, and the phases follow each other", () => {
  const phases = phasesOf(trace);
  expect(phases.map(({ phase }) => phase)).toEqual(["lines", "patches", "volume"]);
  expect(phases[0]?.from).toBe(firstState(trace));
  expect(phases.at(-1)?.to).toBe(trace.stepCount);
  phases.slice(1).forEach(({ from }, i) => expect(from).toBe((phases[i]?.to ?? NaN) + 1));
  for (const { phase, from, to } of phases) {
    expect(phaseAt(trace, from).phase).toBe(phase);
    expect(phaseAt(trace, to).phase).toBe(phase);
  }
  expect(surfaceState(trace, firstState(trace))).toBe(0);
  expect(surfaceState(trace, -1)).toBe(surfaceOf().stepCount);
  expect(surfaceState(trace, 0)).toBeNull();
});

test("the ends of phases lead to those of the phases beside them", () => {
  const [lines, patches, volume] = phasesOf(trace);
  if (!lines || !patches || !volume) throw new Error("a phase is missing");
  expect(phaseStart(trace, 5)).toBe(0);
  expect(phaseStart(trace, 0)).toBe(patches.from);
  expect(phaseStart(trace, patches.from)).toBe(lines.from);
  expect(phaseStart(trace, lines.from)).toBe(lines.from);
  expect(phaseEnd(trace, lines.from)).toBe(lines.to);
  expect(phaseEnd(trace, lines.to)).toBe(patches.to);
  expect(phaseEnd(trace, patches.to)).toBe(trace.stepCount);
  expect(phaseEnd(trace, trace.stepCount)).toBe(trace.stepCount);
});

test("the kinds of steps to jump to are those that a search from the first line finds", () => {
  const found = stopKinds.filter((kind) => nextStop(trace, firstState(trace), 1, kind) !== null);
  expect(stopKindsOf(trace)).toEqual(found);
  expect(found).toContain("line");
});

test("jumps find each line and each patch, and refusals in patches", () => {
  const all = (kind: "line" | "patch"): number[] => {
    const found: number[] = [];
    for (let at = nextStop(trace, firstState(trace), 1, kind); at !== null; at = nextStop(trace, at, 1, kind))
      found.push(at);
    return found;
  };
  expect(all("line")).toHaveLength(12);
  expect(all("patch")).toHaveLength(6);
  const refused = nextStop(trace, firstState(trace), 1, "too-close");
  if (refused === null) throw new Error("nothing was refused");
  const step = surfaceOf().stepAt(surfaceState(trace, refused) ?? 0);
  if (step?.kind !== "edge") throw new Error("the step has no base edge");
  const candidate = step.candidates[refusedIn(trace, refused, "too-close") ?? -1];
  expect(candidate?.verdict).toBe("too-close");
  const front = surfaceOf().fronts[step.front];
  if (!front || !candidate) throw new Error("the step has no front");
  const examined = examineCandidate(front, step, candidate);
  expect(examined.distance).toBeLessThan(examined.leastDistance);
});

test("plane and space show the same triangles and edges", () => {
  const surface = surfaceOf();
  const drawn = (path: string): number => path.split("M").length - 1;
  for (let state = surface.lastLineStep + 1; state <= surface.stepCount; state += 7) {
    const front = surface.fronts[surface.frontAt(state) ?? -1];
    if (!front) throw new Error(`state ${state} has no front`);
    const paths = planePaths(front, state);
    const scene = surfaceScene(trace, state);
    expect(scene.front).toHaveLength(2 * paths.edgeCount);
    expect(drawn(paths.front)).toBe(paths.edgeCount);
    expect(drawn(paths.triangles)).toBe(paths.triangleCount);
    expect(frontSizeAt(trace, state + firstState(trace))).toBe(paths.edgeCount);
    if (state < front.lastStep) expect(scene.made).toBe(paths.triangleCount);
  }
});

test("the sides of all lines are drawn when the lines are divided", () => {
  const surface = surfaceOf();
  expect(surfaceScene(trace, 0)).toMatchObject({ sides: [], front: [], finished: 0 });
  const { sides } = surfaceScene(trace, surface.lastLineStep);
  expect(sides).toHaveLength(2 * surface.summary().lines.sides);
});

test("an address names the candidates that a step has tried, also in patches", () => {
  for (let state = firstState(trace); state <= Math.min(trace.stepCount, 50); state++) {
    const inSurface = surfaceState(trace, state);
    const step = inSurface === null ? trace.stepAt(state) : surfaceOf().stepAt(inSurface);
    const count = step && "candidates" in step ? step.candidates.length : 0;
    const known = [null, 0, 1, 2, 3].map((candidate) => knownCandidate(trace, state, candidate));
    expect(known).toEqual([null, ...[0, 1, 2, 3].map((candidate) => (candidate < count ? candidate : null))]);
  }
  const edge = surfaceOf().lastLineStep + 2 + firstState(trace);
  expect(knownCandidate(trace, edge, 0)).toBe(0);
});

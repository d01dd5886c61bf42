/** The lines and patches of all models of the gallery, as recorded: replays, and the engine's verdicts in the plane. */
import { createMesher, type Mesher } from "tetrafront";
import type { EdgeStep, PlanarFront, SurfaceTrace } from "tetrafront/trace";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { modelIds, recordSurface, type RecordedModel } from "../../support/recorded-models";
import {
  clearance,
  crossedEdges,
  crossesEdge,
  distanceToEdge,
  edgesAt,
  isBehindEdge,
  metricLength,
  newTriangle,
  planeOf,
  targetLength,
  touching,
} from "../../../web/teach/player/planar-judge";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** Rounding of sizes and metrics, of which the file has three bytes. */
const rounding = 1e-4;
/** Bytes that a step may take on average. */
const maxBytesPerStep = 60;

function surfaceOf({ trace }: RecordedModel): SurfaceTrace {
  if (trace.surface === null) throw new Error("the trace has no lines and patches");
  return trace.surface;
}

/** Sorted nodes of triangles, one text per triangle. */
const sorted = (triangles: Iterable<readonly number[]>): string[] =>
  [...triangles].map((nodes) => [...nodes].sort((a, b) => a - b).join(" ")).sort();

const triples = (numbers: Uint32Array, map = (node: number): number => node): number[][] =>
  Array.from({ length: numbers.length / 3 }, (_, i) => [...numbers.subarray(3 * i, 3 * i + 3)].map(map));

const sum = (numbers: readonly number[]): number => numbers.reduce((total, number) => total + number, 0);

/** Twice the area to the left of edges. */
const doubleArea = (front: PlanarFront, edges: readonly (readonly [number, number])[]): number =>
  sum(
    edges.map(([from, to]) => {
      const [ax, ay] = planeOf(front, from);
      const [bx, by] = planeOf(front, to);
      return ax * by - ay * bx;
    }),
  );

/**
 * Returns what is wrong with the verdicts of a step: the accepted candidate comes last and all others fail for the reason
 * given.
 */
function wrongIn(front: PlanarFront, step: EdgeStep): string[] {
  const target = targetLength(front, step);
  const present = edgesAt(front, step.step - 1);
  const arms = step.nodes.map((node) => {
    const [x, y] = planeOf(front, node);
    return metricLength(step.metric, [step.ideal[0] - x, step.ideal[1] - y]);
  });
  const wrong = step.candidates.flatMap((candidate, i) => {
    const isLast = i === step.candidates.length - 1;
    const isRight = isRightVerdict(front, step, candidate, { present, target });
    return isRight && (candidate.verdict === "accepted") === (isLast && step.outcome === "accepted")
      ? []
      : [`step ${step.step}: candidate ${i} ${candidate.verdict}`];
  });
  const isIdeal = arms.every((arm) => Math.abs(arm / target - 1) < 1e-3);
  if (!isIdeal) wrong.push(`step ${step.step}: the ideal point`);
  if (!present.includes(step.edge)) wrong.push(`step ${step.step}: the base edge`);
  return wrong;
}

function isRightVerdict(
  front: PlanarFront,
  step: EdgeStep,
  { node, isNew, plane, verdict, culprit }: EdgeStep["candidates"][number],
  { present, target }: { readonly present: readonly number[]; readonly target: number },
): boolean {
  const triangle = newTriangle(front, step.nodes, plane, isNew ? null : node);
  const distance = (edge: number): number => distanceToEdge(front, step.metric, plane, edge);
  if (culprit !== null && !present.includes(culprit)) return false;
  switch (verdict) {
    case "behind":
      return isBehindEdge(front, triangle);
    case "crosses":
      return crossesEdge(front, triangle, culprit ?? 0, touching);
    case "too-close":
      return distance(culprit ?? 0) < clearance * target * (1 + rounding);
    case "same-node":
      return step.nodes.some((end) => front.surfaceNodes[end] === front.surfaceNodes[node ?? 0]);
    case "outside":
      return !isInBox(front, plane);
    case "accepted": {
      const isClear = (edge: number): boolean =>
        edge === step.edge || distance(edge) > clearance * target * (1 - rounding);
      return (
        !isBehindEdge(front, triangle) &&
        crossedEdges(front, step.step - 1, triangle).length === 0 &&
        (!isNew || present.every(isClear))
      );
    }
  }
}

function isInBox(front: PlanarFront, position: readonly [number, number]): boolean {
  return [0, 1].every((axis) => {
    const along = Array.from({ length: front.boundaryNodes }, (_, node) => front.plane[2 * node + axis] ?? 0);
    const at = position[axis] ?? 0;
    return Math.min(...along) <= at && at <= Math.max(...along);
  });
}

describe.each(modelIds)("%s:", (id) => {
  let model: RecordedModel;
  beforeAll(async () => {
    model = await recordSurface(mesher, id);
  });

  test("the patches are replayed to the triangles of the surface", () => {
    const surface = surfaceOf(model);
    const { trianglePatch, triangles } = model.result.mesh;
    const replayed = new Map<number, string[]>();
    surface.fronts.forEach((front, i) => {
      const nodes = surface.surfaceNodesOf(i);
      if (nodes === null || front.improved === null) return;
      replayed.set(front.patch, sorted(triples(front.improved.triangles, (node) => nodes[node] ?? -1)));
    });
    const recorded = new Map<number, number[][]>();
    triples(triangles).forEach((nodes, i) => {
      const patch = trianglePatch[i] ?? 0;
      if (replayed.has(patch)) recorded.set(patch, [...(recorded.get(patch) ?? []), nodes]);
    });
    expect(replayed.size).toBe(new Set(surface.fronts.map(({ patch }) => patch)).size);
    for (const [patch, nodes] of recorded)
      expect(replayed.get(patch), `patch ${patch}`).toEqual(sorted(nodes));
    expect([...recorded.keys()].sort()).toEqual([...replayed.keys()].sort());
  });

  test("each front covers its patch from empty, and closes", () => {
    for (const front of surfaceOf(model).fronts) {
      const edges = (indices: readonly number[]): [number, number][] =>
        indices.map((edge) => [front.edges[2 * edge] ?? 0, front.edges[2 * edge + 1] ?? 0]);
      const outline = edges(edgesAt(front, front.firstStep));
      const ofTriangles = triples(front.triangles).map(([a = 0, b = 0, c = 0]) =>
        doubleArea(front, [
          [a, b],
          [b, c],
          [c, a],
        ]),
      );
      expect(Math.min(...ofTriangles)).toBeGreaterThan(0);
      const area = doubleArea(front, outline);
      expect(Math.abs(sum(ofTriangles) / area - 1)).toBeLessThan(1e-9);
      expect(edgesAt(front, front.lastStep)).toEqual([]);
    }
  });

  test("candidates were accepted and refused for good reasons", () => {
    const surface = surfaceOf(model);
    const wrong: string[] = [];
    const verdicts = { accepted: 0, postponed: 0, refused: 0 };
    for (let i = 1; i <= surface.stepCount; i++) {
      const step = surface.stepAt(i);
      if (step?.kind !== "edge") continue;
      const front = surface.fronts[step.front];
      if (front === undefined) throw new Error(`step ${i} has no front`);
      wrong.push(...wrongIn(front, step));
      ++verdicts[step.outcome];
      verdicts.refused += step.candidates.filter(({ verdict }) => verdict !== "accepted").length;
    }
    expect(wrong).toEqual([]);
    const { patches } = surface.summary();
    expect(verdicts).toEqual({
      accepted: patches.accepted,
      postponed: patches.postponed,
      refused: sum(Object.values(patches.refused)),
    });
  });

  test("every line is divided into sides of about the target size", () => {
    const surface = surfaceOf(model);
    const { lines } = surface.summary();
    expect(lines.sides).toBe(model.result.sideLine.length);
    surface.divisions.forEach((division, index) => {
      const { firstStep, lastStep, stations, nodes, length } = division;
      expect(lastStep - firstStep).toBe(stations.length / 3);
      expect(Math.abs(nodes.length / 3 - 1 - length)).toBeLessThan(6.5);
      let before = 0;
      for (let i = firstStep; i < lastStep; i++) {
        const step = surface.stepAt(i);
        if (step?.kind !== "station") throw new Error(`step ${i} is no station`);
        expect(step.division).toBe(index);
        expect(step.sides).toBeGreaterThan(before);
        // A step that S3 has settled is about one side long.
        if (step.end === "settled") expect(Math.abs(step.sides - before - 1)).toBeLessThan(0.35);
        before = step.sides;
      }
    });
  });

  test("a step takes few bytes", () => {
    const { surface, steps, nodes } = model.trace;
    const events = (steps.offsets[1] ?? 0) - 24 * model.trace.header.nodes;
    expect(nodes.positions.length).toBeGreaterThan(0);
    expect(events / (surface?.stepCount ?? 1)).toBeLessThan(maxBytesPerStep);
  });
});

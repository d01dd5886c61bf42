import { createMesher, type Mesher } from "tetrafront";
import { readProject, type Project, type ProjectPreview } from "tetrafront/project";
import { readFileSync } from "node:fs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { DocumentStore } from "../../../web/session/document-store";
import { changedPart, withPart } from "../../../web/session/part-preview";
import { PreviewFeed } from "../../../web/session/preview";
import type { Position } from "../../../web/document/position";
import { cross, length, subtract } from "../../../web/document/vectors";
import { movePoint } from "../../support/projects";
import { randomSource } from "../../support/random";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

/** Returns the area of each sampled patch. */
function areasOf({ patchOffsets, patchPoints, patchTriangles }: ProjectPreview): number[] {
  return Array.from({ length: patchOffsets.length - 1 }, (_, patch) => {
    let area = 0;
    for (let t = patchOffsets[patch] ?? 0; t < (patchOffsets[patch + 1] ?? 0); ++t) {
      const [a = 0, b = 0, c = 0] = patchTriangles.subarray(3 * t, 3 * t + 3);
      const at = (node: number): Position => [
        patchPoints[3 * node] ?? NaN,
        patchPoints[3 * node + 1] ?? NaN,
        patchPoints[3 * node + 2] ?? NaN,
      ];
      area += length(cross(subtract(at(b), at(a)), subtract(at(c), at(a)))) / 2;
    }
    return area;
  });
}

function sampleModel(id: string): Project {
  const read = readProject(
    readFileSync(new URL(`../../../public/models/${id}.json`, import.meta.url), "utf8"),
  );
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

function movePoints(project: Project, ids: ReadonlySet<number>, [dx, dy, dz]: Position): Project {
  const points = project.points.map((point) => {
    const [x, y, z] = point.position;
    return ids.has(point.id) ? { ...point, position: [x + dx, y + dy, z + dz] as const } : point;
  });
  return { ...project, points };
}

/** Returns the mean of the triangles of each sampled patch, by their areas. */
function centroidsOf({ patchOffsets, patchPoints, patchTriangles }: ProjectPreview): Position[] {
  return Array.from({ length: patchOffsets.length - 1 }, (_, patch) => {
    const sum: [number, number, number] = [0, 0, 0];
    let total = 0;
    for (let t = patchOffsets[patch] ?? 0; t < (patchOffsets[patch + 1] ?? 0); ++t) {
      const corners = Array.from(patchTriangles.subarray(3 * t, 3 * t + 3), (node): Position => {
        const [x = NaN, y = NaN, z = NaN] = patchPoints.subarray(3 * node, 3 * node + 3);
        return [x, y, z];
      });
      const [a, b, c] = corners;
      if (!a || !b || !c) throw new Error("a triangle has three corners");
      const area = length(cross(subtract(b, a), subtract(c, a))) / 2;
      total += area;
      for (const axis of [0, 1, 2] as const) sum[axis] += (area * (a[axis] + b[axis] + c[axis])) / 3;
    }
    return [sum[0] / total, sum[1] / total, sum[2] / total];
  });
}

const largestDifference = (a: Float64Array, b: Float64Array): number =>
  a.reduce((most, x, i) => Math.max(most, Math.abs(x - (b[i] ?? Infinity))), 0);

describe("the preview of the part that an edit changes", () => {
  it.each(["chain", "engine-intake", "pipe-flange", "vault", "y-pipe", "wing-in-a-tunnel"])(
    "gives the same samples as one of the whole project: %s",
    async (id) => {
      const before = sampleModel(id);
      const sampled = await mesher.previewProject(before);
      const random = randomSource(7);
      for (let round = 0; round < 6; ++round) {
        const { id: point } = before.points[random() % before.points.length] ?? { id: 0 };
        const after = movePoint(before, point, [1e-3, -2e-3, 1e-3]);
        const part = changedPart(before, after);
        if (!part) continue;
        const own = part.project && (await mesher.previewProject(part.project, { samplesOnly: true }));
        const samples = withPart(sampled, own, part);
        const expected = await mesher.previewProject(after);
        // The density of the samples may depend on the whole model; the shape does not.
        expect(samples.lineOffsets).toHaveLength(expected.lineOffsets.length);
        const [areas, wanted] = [areasOf(samples), areasOf(expected)];
        expect(areas).toHaveLength(wanted.length);
        wanted.forEach((area, patch) => expect((areas[patch] ?? 0) / area).toBeCloseTo(1, 2));
        part.patches.forEach((patch) => expect(areas[patch]).toBeGreaterThan(0));
      }
    },
  );

  it.each(["chain", "engine-intake", "pipe-flange", "vault", "y-pipe", "wing-in-a-tunnel"])(
    "moves what is moved as a whole, without a sample: %s",
    async (id) => {
      const before = sampleModel(id);
      const sampled = await mesher.previewProject(before);
      const offset = [0.125, -0.5, 0.0625] as const;
      const after = movePoints(before, new Set(before.points.map((point) => point.id)), offset);
      const part = changedPart(before, after);
      if (!part) throw new Error("nothing has changed");
      expect(part.project).toBeNull();
      const samples = withPart(sampled, null, part);
      const expected = await mesher.previewProject(after);
      expect(samples.lineOffsets).toEqual(expected.lineOffsets);
      expect(largestDifference(samples.linePoints, expected.linePoints)).toBeLessThan(1e-9);
      expect(samples.patchOffsets).toEqual(expected.patchOffsets);
      expect(largestDifference(samples.patchPoints, expected.patchPoints)).toBeLessThan(1e-9);
      // The samples that were shown stay as they are.
      const again = await mesher.previewProject(before);
      expect(sampled.linePoints).toEqual(again.linePoints);
      expect(sampled.patchPoints).toEqual(again.patchPoints);
    },
  );

  it("moves some patches as a whole and samples those beside them", async () => {
    const before = sampleModel("chain");
    const sampled = await mesher.previewProject(before);
    const [patch] = before.patches;
    const around = new Set(patch?.loops.flat().map(Math.abs));
    const ids = new Set(before.lines.filter(({ id }) => around.has(id)).flatMap(({ points }) => points));
    const after = movePoints(before, ids, [1e-3, 2e-3, -1e-3]);
    const part = changedPart(before, after);
    expect(part?.shifted?.patches).toContain(0);
    expect(part?.patches).not.toContain(0);
    expect(part?.patches.length).toBeGreaterThan(0);
    if (!part?.project) throw new Error("nothing is to be sampled");
    const samples = withPart(sampled, await mesher.previewProject(part.project), part);
    const expected = await mesher.previewProject(after);
    const areas = areasOf(expected);
    areasOf(samples).forEach((area, i) => expect(area / (areas[i] ?? 0)).toBeCloseTo(1, 2));
    const [centroids, wanted, former] = [samples, expected, sampled].map(centroidsOf);
    const distances = wanted?.map((centroid, i) =>
      length(subtract(centroids?.[i] ?? [NaN, NaN, NaN], centroid)),
    );
    expect(distances?.[0]).toBeLessThan(1e-9);
    expect(former?.[0] && wanted?.[0] && length(subtract(former[0], wanted[0]))).toBeGreaterThan(1e-3);
    expect(Math.max(...(distances ?? []))).toBeLessThan(1e-3);
    expect(sampled.patchPoints).toEqual((await mesher.previewProject(before)).patchPoints);
  });

  it("finds the offset of points far from the origin, in any order, and none if points move apart", () => {
    // The offset of the far points is rounded by 1e-11.
    const offset = 0.1;
    const far = [1e5, 1e5 + 1, 1e5 + 3];
    const project = (shift: (x: number, index: number) => number, xs: readonly number[]): Project => ({
      ...emptyProject("points"),
      points: xs.map((x, i) => ({ id: i + 1, position: [shift(x, i), 0, 0] })),
      lines: [{ id: 1, type: "straight", points: [1, 2] }],
    });
    for (const xs of [
      [...far, 0.1, 0.7],
      [0.1, 0.7, ...far],
    ]) {
      const before = project((x) => x, xs);
      const lines = { lines: before.lines };
      const moved = changedPart(before, { ...project((x) => x + offset, xs), ...lines });
      expect(moved?.shifted?.lines).toEqual(new Set([0]));
      expect(moved?.project).toBeNull();
      const apart = changedPart(before, { ...project((x, i) => x + offset * (1 + i * 1e-5), xs), ...lines });
      expect(apart?.shifted ?? null).toBeNull();
    }
  });

  it("is not made if nothing or too much has changed, or if there are other entities", () => {
    const project = sampleModel("chain");
    expect(changedPart(project, { ...project, name: "Copy" })).toBeNull();
    const points = project.points.map(({ position: [x, y, z], ...point }) => ({
      ...point,
      position: [2 * x, y, z] as const,
    }));
    expect(changedPart(project, { ...project, points })).toBeNull();
    expect(changedPart(project, { ...project, patches: project.patches.slice(1) })).toBeNull();
    const one = changedPart(project, movePoint(project, project.points[0]?.id ?? 0, [0, 0, 1]));
    expect(one?.patches.length).toBeGreaterThan(0);
    expect(one?.patches.length).toBeLessThan(project.patches.length / 2);
  });
});

it("a slow preview samples only what an edit changes, and checks the whole project when the edits rest", async () => {
  const chain = sampleModel("chain");
  const asked: number[] = [];
  const slow: Pick<Mesher, "previewProject"> = {
    previewProject: async (project, options, control) => {
      asked.push(project.patches.length);
      const preview = await mesher.previewProject(project, options, control);
      if (project.patches.length === chain.patches.length) {
        await new Promise((resolve) => setTimeout(resolve, 40));
      }
      return preview;
    },
  };
  const documents = new DocumentStore(chain, () => 0);
  const feed = new PreviewFeed(documents, Promise.resolve(slow as Mesher));
  const until = (isReached: () => boolean): Promise<void> =>
    new Promise((resolve) => {
      const stop = feed.state.subscribe(() => {
        if (!isReached()) return;
        stop();
        resolve();
      });
    });
  const state = () => feed.state.getState();
  await until(() => state().checked === chain);
  const [point] = chain.points;
  if (!point) throw new Error("the model has no points");
  const gesture = documents.begin("Move");
  for (let step = 1; step <= 5; ++step) {
    gesture.update({
      change: ({ project }) => {
        const first = project.points[0];
        if (first) first.position[0] = point.position[0] + step / 1000;
      },
    });
    await until(() => state().project === documents.project);
    expect(state().checked).toBe(chain);
  }
  expect(asked.slice(1).every((patches) => patches < chain.patches.length / 2)).toBe(true);
  expect(feed.busy).toBe(true);
  await until(() => state().checked === documents.project);
  expect(asked.at(-1)).toBe(chain.patches.length);
  gesture.commit();
  await new Promise((resolve) => setTimeout(resolve, 0));
  expect(feed.busy).toBe(false);
});

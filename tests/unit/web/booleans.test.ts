import Module, { type ManifoldToplevel } from "manifold-3d";
import { createMesher } from "tetrafront";
import { bodySurface, createBody, type Project, type ProjectPreview } from "tetrafront/project";
import { beforeAll, describe, expect, it } from "vitest";
import { booleanKinds, type BooleanKind } from "../../../web/document/booleans/kinds";
import { offerBoolean } from "../../../web/document/booleans/offer";
import { orientedSurface } from "../../../web/document/booleans/orientation";
import { solidOf, touchedBodies, type Solid } from "../../../web/document/booleans/solids";
import { emptyProject } from "../../../web/document/create";
import { insertInto, insertion } from "../../../web/document/insert-shape";
import { pieceOperations } from "../../../web/document/operations/pieces";
import { box as boxShape } from "../../../web/document/pieces/box";
import type { Position } from "../../../web/document/position";
import { mapPoints } from "../../../web/document/shape";
import { mapPosition, rotationAbout } from "../../../web/document/transforms/affine";
import { DocumentStore } from "../../../web/session/document-store";
import { randomSource } from "../../support/random";
import { boxSurface } from "../../support/surfaces";

let library: ManifoldToplevel;

beforeAll(async () => {
  library = await Module();
  library.setup();
});

interface Box {
  readonly size: Position;
  readonly low: Position;
  /** Degrees about (1, 2, 3). */
  readonly turned?: number;
}

/** A project of boxes whose patches are called "0 …", "1 …" and so on. */
function boxes(...list: readonly Box[]): Project {
  const project = emptyProject("Boxes");
  const lists = { points: [...project.points], lines: [...project.lines], patches: [...project.patches] };
  list.forEach(({ size: [width, depth, height], low, turned = 0 }, index) => {
    const turn = rotationAbout([0, 0, 0], [1, 2, 3], turned);
    const shape = mapPoints(boxShape(width, depth, height), ([x, y, z]) =>
      mapPosition(turn, [x + low[0] + width / 2, y + low[1] + depth / 2, z + low[2]]),
    );
    const patches = shape.patches.map((patch) => ({ ...patch, name: `${index} ${patch.name ?? ""}` }));
    insertInto(lists, insertion({ ...project, ...lists }, { ...shape, patches }, { join: false }));
  });
  return { ...project, ...lists };
}

/** The corners of a loop of straight lines. */
function corners({ lines, points }: Project, loop: readonly number[]): Position[] {
  return loop.map((step) => {
    const line = lines.find(({ id }) => id === Math.abs(step));
    const from = step > 0 ? line?.points[0] : line?.points.at(-1);
    const point = points.find(({ id }) => id === from);
    if (!point) throw new Error("a loop has a line without points");
    return point.position;
  });
}

/** Samples of convex planar patches, as the engine would make them. */
function samplesOf(project: Project): ProjectPreview {
  const indices = new Map(project.points.map(({ position }, index) => [position, index]));
  const patchTriangles: number[] = [];
  const patchOffsets = [0];
  for (const { loops } of project.patches) {
    const [first = 0, ...rest] = corners(project, loops[0] ?? []).map((at) => indices.get(at) ?? 0);
    rest.slice(1).forEach((node, i) => patchTriangles.push(first, rest[i] ?? 0, node));
    patchOffsets.push(patchTriangles.length / 3);
  }
  const patchPoints = project.points.flatMap(({ position }) => [...position]);
  return { patchOffsets, patchTriangles, patchPoints } as unknown as ProjectPreview;
}

const allSolids = (project: Project, samples = samplesOf(project)): Solid[] =>
  touchedBodies(project, []).flatMap((entities) => solidOf(project, entities, samples) ?? []);

function solidsOf(project: Project): readonly [Solid, Solid] {
  const [first, second] = allSolids(project);
  if (!first || !second) throw new Error("the project has no two closed bodies");
  return [first, second];
}

function combined(project: Project, kind: BooleanKind, solids = solidsOf(project)): Project {
  const offer = offerBoolean(library, project, solids, kind);
  if (!offer.possible) throw new Error(offer.reason);
  const documents = new DocumentStore(project);
  documents.edit(offer.creation.edit);
  return documents.project;
}

/** Volume within planar patches, by the divergence theorem with the loops' own orientation relative to the outer one. */
function volumeOf(project: Project): number {
  const inside = project.patches.map(({ loops }) =>
    loops.flatMap((loop) => {
      const [a, ...rest] = corners(project, loop);
      return rest.slice(1).map((c, i) => {
        const b = rest[i];
        if (!a || !b) return 0;
        return (
          (a[0] * (b[1] * c[2] - b[2] * c[1]) +
            a[1] * (b[2] * c[0] - b[0] * c[2]) +
            a[2] * (b[0] * c[1] - b[1] * c[0])) /
          6
        );
      });
    }),
  );
  return inside.flat().reduce((sum, part) => sum + part, 0);
}

/** Whether each line bounds exactly two patches, once in each direction. */
function isClosed({ lines, patches }: Project): boolean {
  const steps = patches.flatMap(({ loops }) => loops.flat()).sort((a, b) => a - b);
  const ids = lines.map(({ id }) => id);
  return steps.join() === [...ids.map((id) => -id), ...ids].sort((a, b) => a - b).join();
}

const unit: Box = { size: [1, 1, 1], low: [0, 0, 0] };
const counts = ({ points, lines, patches }: Project) => [points.length, lines.length, patches.length];

describe("Boolean operations on planar bodies", () => {
  it("cut a corner off a cube: points, lines and patches with exact coordinates and their names", () => {
    const project = boxes(unit, { size: [1, 1, 1], low: [0.7, 0.6, 0.5] });
    const result = combined(project, "difference");
    expect(counts(result)).toEqual([14, 21, 9]);
    expect(isClosed(result)).toBe(true);
    expect(volumeOf(result)).toBeCloseTo(1 - 0.3 * 0.4 * 0.5, 14);
    const names = result.patches.map(({ name }) => name?.[0]);
    expect(names.filter((name) => name === "0")).toHaveLength(6);
    expect(names.filter((name) => name === "1")).toHaveLength(3);
    const values = new Set(result.points.flatMap(({ position }) => position));
    for (const x of values) expect([0, 1, 0.7, 0.6, 0.5]).toContain(Number(x.toPrecision(15)));
    expect(result.patches.every(({ type }) => type === "planar")).toBe(true);
  });

  it("drill a square hole: two patches have a hole, and the surface has a handle", () => {
    const result = combined(boxes(unit, { size: [0.5, 0.5, 3], low: [0.25, 0.25, -1] }), "difference");
    expect(counts(result)).toEqual([16, 24, 10]);
    expect(result.patches.filter(({ loops }) => loops.length === 2)).toHaveLength(2);
    expect(isClosed(result)).toBe(true);
    expect(volumeOf(result)).toBeCloseTo(0.75, 14);
  });

  it("leave a cavity, and two shells", () => {
    const result = combined(boxes(unit, { size: [0.5, 0.5, 0.5], low: [0.25, 0.25, 0.25] }), "difference");
    expect(counts(result)).toEqual([16, 24, 12]);
    expect(volumeOf(result)).toBeCloseTo(1 - 0.125, 14);
  });

  it("cut a box in two: patches that are cut become two", () => {
    const result = combined(
      boxes({ size: [3, 1, 1], low: [0, 0, 0] }, { size: [1, 3, 3], low: [1, -1, -1] }),
      "difference",
    );
    expect(counts(result)).toEqual([16, 24, 12]);
    expect(new Set(result.patches.map(({ name }) => name)).size).toBe(12);
    expect(volumeOf(result)).toBeCloseTo(2, 14);
  });

  it("unite boxes that share a part of a side", () => {
    const result = combined(boxes(unit, { size: [0.5, 0.5, 0.5], low: [0.25, 0.25, 1] }), "union");
    expect(isClosed(result)).toBe(true);
    expect(volumeOf(result)).toBeCloseTo(1.125, 14);
    expect(counts(result)).toEqual([16, 24, 11]);
  });

  it("give nothing if nothing is left, and leave other entities alone", () => {
    const apart = boxes(unit, { size: [1, 1, 1], low: [5, 5, 5] });
    expect(offerBoolean(library, apart, solidsOf(apart), "intersection").possible).toBe(false);
    const three = boxes(unit, { size: [1, 1, 1], low: [0.5, 0.5, 0.5] }, { size: [1, 1, 1], low: [7, 0, 0] });
    const solids = allSolids(three);
    expect(solids).toHaveLength(3);
    const [first, second] = solids;
    if (!first || !second) throw new Error("there are no solids");
    const result = combined(three, "union", [first, second]);
    expect(result.patches.filter(({ name }) => name?.startsWith("2 "))).toEqual(three.patches.slice(12));
    expect(result.points.map(({ id }) => id)).toEqual(
      expect.arrayContaining(three.points.slice(16).map(({ id }) => id)),
    );
  });

  it.each([1, 2, 3, 4, 5, 6, 7, 8])("agree with each other on volumes of turned boxes (seed %i)", (seed) => {
    const source = randomSource(seed);
    const next = (): number => source() / 2 ** 32;
    const box = (): Box => ({
      size: [0.5 + next(), 0.5 + next(), 0.5 + next()],
      low: [next() - 0.7, next() - 0.7, next() - 0.7],
      turned: 360 * next(),
    });
    const project = boxes(box(), box());
    const [a, b] = solidsOf(project).map(({ points, triangles }) => triangleVolume(points, triangles));
    const volumes = new Map(booleanKinds.map((kind) => [kind, combined(project, kind)]));
    const volume = (kind: BooleanKind): number => {
      const result = volumes.get(kind);
      if (!result) throw new Error(kind);
      expect(isClosed(result)).toBe(true);
      return volumeOf(result);
    };
    const common = volume("intersection");
    expect(volume("union")).toBeCloseTo((a ?? 0) + (b ?? 0) - common, 9);
    expect(volume("difference")).toBeCloseTo((a ?? 0) - common, 9);
  });
});

function triangleVolume(points: Float64Array, triangles: Uint32Array): number {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) =>
      points.subarray(3 * (triangles[t + k] ?? 0), 3 * (triangles[t + k] ?? 0) + 3),
    );
    if (!a || !b || !c) continue;
    const x = (v: Float64Array, k: number): number => v[k % 3] ?? 0;
    for (let k = 0; k < 3; ++k)
      sum += (x(a, k) * (x(b, k + 1) * x(c, k + 2) - x(b, k + 2) * x(c, k + 1))) / 6;
  }
  return sum;
}

describe("Boolean operations on other bodies", () => {
  it("give a closed body with the names of the patches of which something is left", () => {
    const project = boxes(unit, { size: [0.5, 0.5, 3], low: [0.25, 0.25, -1] });
    const [first, second] = solidsOf(project);
    const result = combined(project, "difference", [first, { ...second, isPlanar: false }]);
    const [body] = result.bodies ?? [];
    if (!body) throw new Error("there is no body");
    expect(counts(result)).toEqual([0, 0, 0]);
    const { points, triangles } = bodySurface(body);
    expect([...(orientedSurface(points, triangles)?.triangles ?? [])]).toEqual([...triangles]);
    expect(triangleVolume(points, triangles)).toBeCloseTo(0.75, 6);
    expect(body.patches).toHaveLength(10);
    expect(new Set(body.patches.map(({ name }) => name)).size).toBe(10);
  });
});

/**
 * Nested cubes with the middle (2, 2, 2) as one body, all oriented outward, in a project in which inner shells bound cavities; and
 * a box that covers x < 2.
 */
function nestedAndHalf(...edges: readonly number[]): Project {
  const project = boxes({ size: [4, 8, 8], low: [-2, -2, -2] });
  const cubes = edges.map((edge) => boxSurface(2, cubeCorner(2 - edge / 2), cubeCorner(2 + edge / 2)));
  const offset = (index: number): number =>
    cubes.slice(0, index).reduce((sum, { points }) => sum + points.length / 3, 0);
  const triangles = cubes.flatMap((cube, index) => [...cube.triangles].map((node) => node + offset(index)));
  const surface = {
    points: Float64Array.from(cubes.flatMap(({ points }) => [...points])),
    triangles: Uint32Array.from(triangles),
    trianglePatch: new Uint32Array(triangles.length / 3),
    patches: [{ name: "cubes" }],
  };
  const bodies = [createBody(surface, { id: 1, firstPatchId: 100, name: "cubes" })];
  return { ...project, bodies, meshing: { innerShells: "cavities" } };
}

const cubeCorner = (x: number): Position => [x, x, x];

describe("Boolean operations on bodies with inner shells", () => {
  it("keep cavities, and what lies in them", () => {
    const volume = (kind: BooleanKind, ...edges: readonly number[]): number => {
      const [body] = combined(nestedAndHalf(...edges), kind).bodies ?? [];
      if (!body) throw new Error("there is no body");
      const { points, triangles } = bodySurface(body);
      return triangleVolume(points, triangles);
    };
    expect(volume("intersection", 4, 2)).toBeCloseTo(32 - 4, 5);
    expect(volume("union", 4, 2)).toBeCloseTo(256 + 32 - 4, 4);
    expect(volume("intersection", 4, 2, 1)).toBeCloseTo(32 - 4 + 0.5, 5);
    expect(volume("intersection", 1, 4, 2)).toBeCloseTo(32 - 4 + 0.5, 5);
  });

  it("are refused if inner shells are regions, also by their orientation", () => {
    for (const innerShells of ["regions", "by-orientation"] as const) {
      const offerIn = (project: Project) =>
        offerBoolean(library, { ...project, meshing: { innerShells } }, solidsOf(project), "intersection");
      expect(offerIn(nestedAndHalf(4, 2))).toMatchObject({ possible: false, reason: /regions/ });
      expect(offerIn(nestedAndHalf(4)).possible).toBe(true);
    }
  });
});

describe("the samples of solid pieces", () => {
  it("are closed, and the volumes of a box without a piece and of the piece add up", async () => {
    const mesher = await createMesher();
    const cube: Box = { size: [9, 9, 9], low: [-4.5, -4.5, -4.5] };
    for (const operation of pieceOperations) {
      const documents = new DocumentStore(boxes(cube));
      const subject = { project: documents.project, selection: [] };
      const values = { ...operation.initial(subject), position: [0.1, 0.2, 0.3] as const };
      const offer = operation.make(subject, values);
      if (!offer.possible) throw new Error(`${operation.id}: ${offer.reason}`);
      documents.edit(offer.creation.edit);
      const { project } = documents;
      const [first, second] = allSolids(project, await mesher.previewProject(project, {}));
      if (!first || !second) throw new Error(`${operation.id} is not closed`);
      const areas = [first, second].map(({ points, triangles }) => triangleVolume(points, triangles));
      const volume = (kind: BooleanKind): number => {
        const { bodies = [], ...drawn } = combined(project, kind, [first, second]);
        const [body] = bodies;
        if (!body) return volumeOf(drawn);
        const { points, triangles } = bodySurface(body);
        expect(orientedSurface(points, triangles)).not.toBeNull();
        return triangleVolume(points, triangles);
      };
      expect(volume("intersection") / (areas[1] ?? 1)).toBeCloseTo(1, 5);
      expect(volume("difference") / ((areas[0] ?? 0) - (areas[1] ?? 0))).toBeCloseTo(1, 5);
    }
    mesher.dispose();
  });
});

describe("the orientation of a surface", () => {
  const tetrahedron = Uint32Array.of(0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2);
  const points = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);

  it("is outward, whichever triangles are flipped", () => {
    for (let flips = 0; flips < 16; ++flips) {
      const given = tetrahedron.slice();
      for (let t = 0; t < 4; ++t) {
        if ((flips >> t) & 1) given.subarray(3 * t, 3 * t + 3).reverse();
      }
      const oriented = orientedSurface(points, given);
      if (!oriented) throw new Error("the tetrahedron is closed");
      expect(triangleVolume(points, oriented.triangles)).toBeCloseTo(1 / 6, 15);
    }
  });

  it("does not exist for an open surface or an edge with three triangles", () => {
    expect(orientedSurface(points, tetrahedron.slice(3))).toBeNull();
    expect(orientedSurface(points, Uint32Array.of(...tetrahedron, 0, 1, 3))).toBeNull();
    expect(orientedSurface(points, new Uint32Array())).toBeNull();
  });
});

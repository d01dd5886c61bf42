/**
 * Solids of an assembly that touch on planes, cylinders, cones and spheres, each triangulated by itself: their common surface is
 * found, also where they overlap in parts. Areas and volumes are known from the formulas of solids of revolution.
 */
import { beforeAll, afterAll, describe, expect, test } from "vitest";

import { createMesher, type Mesher } from "../../../wasm/dist/index.js";
import { withoutPause } from "../../../wasm/src/base/steps.js";
import type { Shape } from "../../../wasm/src/formats/joined-shapes.js";
import { surfaceOfShapes } from "../../../wasm/src/formats/shape-surface.js";
import { surfaceOf } from "../../../wasm/src/formats/surface-file.js";
import {
  arcOf,
  type Motion,
  moved,
  NO_MOTION,
  roundShape,
  straightFaces,
} from "../../support/round-shapes.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const TURNED: Motion = { axis: [2 / 3, -1 / 3, 2 / 3], angle: 0.7, offset: [31.7, -12.9, 5.3] };

/** A plate with a hole of radius 4, between two heights. */
const plate = (name: string, low: number, high: number, phase: number, edges = 60) => ({
  name,
  profile: straightFaces([4, low], [12, low], [12, high], [4, high], [4, low]),
  edges,
  phase,
});

/** A bolt of radius 4 with a head of radius 7 from height 0 to 3; it ends at a height below. */
const bolt = (bottom: number, phase: number, edges = 62) => ({
  name: "bolt",
  profile: straightFaces([0, bottom], [4, bottom], [4, 0], [7, 0], [7, 3], [0, 3]),
  edges,
  phase,
});

interface Made {
  /** Area of the interface between two solids, by their names. */
  readonly areas: ReadonlyMap<string, number>;
  readonly volumes: readonly number[];
  readonly surface: ReturnType<typeof surfaceOfShapes> extends Generator<unknown, infer Mesh, void>
    ? Mesh
    : never;
}

function made(shapes: readonly Shape[]): Made {
  const surface = withoutPause(surfaceOfShapes(shapes));
  const { points, triangles, surfaceRegions } = surface;
  const { regions = [], triangleRegions = new Uint32Array() } = surfaceRegions ?? {};
  const areas = new Map<string, number>();
  const volumes = regions.map(() => 0);
  for (let t = 0; t < triangles.length / 3; t++) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const node = triangles[3 * t + k] ?? 0;
      return [0, 1, 2].map((axis) => points[3 * node + axis] ?? 0);
    }) as [number[], number[], number[]];
    const [u, v] = [b, c].map((p) => p.map((x, k) => x - (a[k] ?? 0))) as [number[], number[]];
    const cross = [0, 1, 2].map((k) => {
      const [i, j] = [(k + 1) % 3, (k + 2) % 3];
      return (u[i] ?? 0) * (v[j] ?? 0) - (u[j] ?? 0) * (v[i] ?? 0);
    });
    const sixfold = cross.reduce((sum, x, k) => sum + x * (a[k] ?? 0), 0);
    const [inside = 0, outside = 0] = triangleRegions.subarray(2 * t, 2 * t + 2);
    volumes[inside] = (volumes[inside] ?? 0) + sixfold / 6;
    if (outside >= regions.length) continue;
    volumes[outside] = (volumes[outside] ?? 0) - sixfold / 6;
    const key = [inside, outside]
      .map((region) => regions[region]?.name ?? "")
      .sort()
      .join("/");
    areas.set(key, (areas.get(key) ?? 0) + Math.hypot(...cross) / 2);
  }
  return { areas, volumes, surface };
}

/** Expects a surface without intersections that encloses each solid. */
async function expectJoined({ surface }: Made, regions: number): Promise<void> {
  const found = await mesher.inspectSurface(withoutPause(surfaceOf(surface)));
  expect(found).toMatchObject({ isFillable: true, regions });
  expect(found.diagnostics.filter(({ severity }) => severity === "error")).toEqual([]);
}

const near = (value: number | undefined, expected: number, share = 0.01): void => {
  expect(Math.abs((value ?? 0) / expected - 1)).toBeLessThan(share);
};

describe.each([
  ["along the axes", NO_MOTION],
  ["turned and moved", TURNED],
])("solids %s:", (_, motion) => {
  const shape = (given: Parameters<typeof roundShape>[0]) => roundShape(given, motion);

  test.each([
    ["ends inside the second plate", -7],
    ["ends with the second plate", -9],
    ["is longer than both plates", -14],
  ])("a bolt that %s shares the holes and its head", async (_name, bottom) => {
    const joined = made([
      shape(plate("upper", -5, 0, 0.013)),
      shape(plate("lower", -9, -5, 0.031, 71)),
      shape(bolt(bottom, 0.02)),
    ]);
    near(joined.areas.get("bolt/upper"), 2 * Math.PI * 4 * 5 + Math.PI * (49 - 16));
    near(joined.areas.get("bolt/lower"), 2 * Math.PI * 4 * Math.min(-5 - bottom, 4));
    near(joined.areas.get("lower/upper"), Math.PI * (144 - 16));
    near(joined.volumes[2], Math.PI * (16 * -bottom + 49 * 3));
    await expectJoined(joined, 3);
  });

  test("faces in halves, at any angle to each other", async () => {
    const joined = made([
      shape({ ...plate("upper", -5, 0, 0.4), isHalved: true }),
      shape({ ...bolt(-8, 0), isHalved: true }),
    ]);
    near(joined.areas.get("bolt/upper"), 2 * Math.PI * 4 * 5 + Math.PI * (49 - 16));
    await expectJoined(joined, 2);
  });

  test("a bush between a shaft and a hub", async () => {
    const tube = (name: string, inner: number, outer: number, low: number, high: number, phase: number) =>
      shape({
        name,
        profile: straightFaces([inner, low], [outer, low], [outer, high], [inner, high], [inner, low]),
        edges: 64,
        phase,
      });
    const shaft = shape({
      name: "shaft",
      profile: straightFaces([0, -9], [3, -9], [3, 9], [0, 9]),
      edges: 64,
      phase: 0.05,
    });
    const joined = made([tube("bush", 3, 4, -3, 4, 0), tube("hub", 4, 9, -2, 2, 0.03), shaft]);
    near(joined.areas.get("bush/hub"), 2 * Math.PI * 4 * 4);
    near(joined.areas.get("bush/shaft"), 2 * Math.PI * 3 * 7);
    await expectJoined(joined, 3);
  });

  test("a countersunk screw shares a part of a cone", async () => {
    // The screw's cone goes on above the plate.
    const screw = straightFaces([0, -9], [2, -9], [2, -4], [7, 1], [7, 2], [0, 2]);
    const countersunk = straightFaces([2, -6], [12, -6], [12, 0], [6, 0], [2, -4], [2, -6]);
    const joined = made([
      shape({ name: "plate", profile: countersunk, edges: 60, phase: 0.01 }),
      shape({ name: "screw", profile: screw, edges: 66, phase: 0 }),
    ]);
    near(joined.areas.get("plate/screw"), 2 * Math.PI * 2 * 2 + Math.PI * (2 + 6) * Math.hypot(4, 4));
    await expectJoined(joined, 2);
  });

  test("a ball in a socket shares a part of a sphere", async () => {
    const socket = [
      ...straightFaces([0, -8], [9, -8], [9, -1], [Math.sqrt(24), -1]),
      arcOf(5, 0, -Math.asin(1 / 5) * (180 / Math.PI), -90, 16),
    ];
    const ball = [
      arcOf(5, 0, -90, 60, 30),
      [
        [2.5, 5 * Math.sin(Math.PI / 3)],
        [0, 5 * Math.sin(Math.PI / 3)],
      ] as const,
    ];
    const joined = made([
      shape({ name: "socket", profile: socket, edges: 60, phase: 0 }),
      shape({ name: "ball", profile: ball, edges: 64, phase: 0.02 }),
    ]);
    near(joined.areas.get("ball/socket"), 2 * Math.PI * 5 * 4, 0.02);
    await expectJoined(joined, 2);
  });

  describe("a ball of radius 5, rotated by 0.9,", () => {
    const rotated = (given: Parameters<typeof roundShape>[0], angle = 0.9): Shape => {
      const { points, ...rest } = roundShape(given, { axis: [0.6, 0.8, 0], angle, offset: [0, 0, 0] });
      const positions = Array.from({ length: points.length / 3 }, (_, p) =>
        moved([points[3 * p] ?? 0, points[3 * p + 1] ?? 0, points[3 * p + 2] ?? 0], motion),
      );
      return { ...rest, points: Float64Array.from(positions.flat()) };
    };
    const wholeBall = { name: "ball", profile: [arcOf(5, 0, -90, 90, 40)], edges: 64, phase: 0.02 };
    const degrees = (sine: number) => Math.asin(sine) * (180 / Math.PI);

    /** A block around the lower part of the ball, up to a height. */
    const socket = (top: number, name = "socket") => {
      const rim = Math.sqrt(25 - top * top);
      const profile = [
        ...straightFaces([0, -8], [9, -8], [9, top], [rim, top]),
        arcOf(5, 0, degrees(top / 5), -90, 24),
      ];
      return { name, profile, edges: 60, phase: 0 };
    };
    /** A block around the upper part of the ball, from a height on. */
    const cap = (bottom: number, edges = 60) => {
      const rim = Math.sqrt(25 - bottom * bottom);
      const profile = [
        ...straightFaces([rim, bottom], [9, bottom], [9, 8], [0, 8]),
        arcOf(5, 0, 90, degrees(bottom / 5), 24),
      ];
      return { name: "cap", profile, edges, phase: 0.03 };
    };
    const inZone = (height: number) => 2 * Math.PI * 5 * height;

    test.each([-3, 0, 3])("shares its socket up to height %s", async (top) => {
      const joined = made([shape(socket(top)), rotated(wholeBall)]);
      near(joined.areas.get("ball/socket"), inZone(5 + top), 0.02);
      near(joined.volumes[1], (4 / 3) * Math.PI * 125, 0.02);
      await expectJoined(joined, 2);
    });

    test("is shared in whichever order the solids are, and with faces in halves", async () => {
      const joined = made([rotated({ ...wholeBall, isHalved: true }), shape(socket(0))]);
      near(joined.areas.get("ball/socket"), inZone(5), 0.02);
      await expectJoined(joined, 2);
    });

    test.each([
      ["two cups with a common rim", 0, 0],
      ["two caps with a gap", -2, 2.5],
    ])("shares %s", async (_name, top, bottom) => {
      const joined = made([shape(socket(top)), shape(cap(bottom, 68)), rotated(wholeBall)]);
      near(joined.areas.get("ball/socket"), inZone(5 + top), 0.02);
      near(joined.areas.get("ball/cap"), inZone(5 - bottom), 0.02);
      await expectJoined(joined, 3);
    });

    test("shares a ring around it", async () => {
      const rim = Math.sqrt(21);
      const ring = {
        name: "ring",
        profile: [
          ...straightFaces([rim, -2], [9, -2], [9, 2], [rim, 2]),
          arcOf(5, 0, degrees(0.4), degrees(-0.4), 8),
        ],
        edges: 60,
        phase: 0,
      };
      const joined = made([shape(ring), rotated(wholeBall)]);
      near(joined.areas.get("ball/ring"), inZone(4), 0.02);
      await expectJoined(joined, 2);
    });

    test("on a neck, shares a deep socket", async () => {
      const stud = {
        name: "stud",
        profile: [
          arcOf(5, 0, -90, 70, 36),
          ...straightFaces(
            [5 * Math.cos((7 * Math.PI) / 18), 5 * Math.sin((7 * Math.PI) / 18)],
            [1.7, 12],
            [0, 12],
          ),
        ],
        edges: 64,
        phase: 0.02,
      };
      const joined = made([shape(socket(2)), rotated(stud, 0.6)]);
      near(joined.areas.get("socket/stud"), inZone(7), 0.02);
      await expectJoined(joined, 2);
    });

    test("of two solids, shares its socket with both", async () => {
      const half = (name: string, from: number) => {
        const flat = straightFaces([5, 0], [0, 0]);
        const profile =
          from < 0
            ? [arcOf(5, 0, -90, 0, 24), ...flat]
            : [...straightFaces([0, 0], [5, 0]), arcOf(5, 0, 0, 90, 24)];
        return { name, profile, edges: 64, phase: from < 0 ? 0 : 0.02 };
      };
      const joined = made([shape(socket(0)), rotated(half("lower", -1)), rotated(half("upper", 1))]);
      const sum = (joined.areas.get("lower/socket") ?? 0) + (joined.areas.get("socket/upper") ?? 0);
      near(sum, inZone(5), 0.02);
      near(joined.areas.get("lower/upper"), Math.PI * 25, 0.02);
      await expectJoined(joined, 3);
    });
  });

  test("a clearance stays: nothing is shared, and nothing is changed", () => {
    const pin = {
      name: "pin",
      profile: straightFaces([0, -9], [3.98, -9], [3.98, 3], [0, 3]),
      edges: 62,
      phase: 0,
    };
    const shapes = [shape(plate("plate", -5, 0, 0.4)), shape(pin)];
    const { areas, surface } = made(shapes);
    expect([...areas.keys()]).toEqual([]);
    expect(surface.triangles.length).toBe(shapes.reduce((sum, { triangles }) => sum + triangles.length, 0));
  });
});

test("the order of the solids does not matter for what they share", () => {
  const shapes = [plate("upper", -5, 0, 0.013), plate("lower", -9, -5, 0.031, 71), bolt(-7, 0.02)].map(
    (given) => roundShape(given, TURNED),
  );
  const [one, other] = [made(shapes), made(shapes.toReversed())].map(({ areas }) => areas);
  for (const [key, area] of one ?? []) near(other?.get(key), area, 1e-3);
  expect(other?.size).toBe(one?.size);
});

describe("a pin that is too thick for its hole", () => {
  const pin = (radius: number) => ({
    name: "pin",
    profile: straightFaces([0, -9], [radius, -9], [radius, 3], [0, 3]),
    edges: 62,
    phase: 0.02,
  });

  test("by next to nothing gets the radius of the hole, which a note says", async () => {
    const joined = made([plate("plate", -5, 0, 0.4), pin(4.004)].map((given) => roundShape(given, TURNED)));
    near(joined.areas.get("pin/plate"), 2 * Math.PI * 4 * 5);
    near(joined.volumes[1], Math.PI * 16 * 12, 0.005);
    expect(joined.surface.notes?.join()).toMatch(/moved a face of "pin" by 0\.004 onto one of "plate"/);
    await expectJoined(joined, 2);
  });

  test("by more keeps its radius", () => {
    const { areas, surface } = made(
      [plate("plate", -5, 0, 0.4), pin(4.1)].map((given) => roundShape(given, TURNED)),
    );
    expect([...areas.keys()]).toEqual([]);
    expect(surface.notes).toBeUndefined();
  });
});

test("a plate that overlaps another one by next to nothing is moved onto it", async () => {
  const box = {
    name: "box",
    profile: straightFaces([0, -0.003], [9, -0.003], [9, 4], [0, 4]),
    edges: 60,
    phase: 0,
  };
  const joined = made([plate("plate", -5, 0, 0.4), box].map((given) => roundShape(given, TURNED)));
  near(joined.areas.get("box/plate"), Math.PI * (81 - 16));
  expect(joined.surface.notes?.join()).toContain('moved a face of "box" by 0.003');
  await expectJoined(joined, 2);
});

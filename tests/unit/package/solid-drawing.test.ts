/** Solids as lines and patches: they have the surface of the solid, and enclose its volume. */
import { afterAll, beforeAll, expect, test } from "vitest";
import { createMesher, type Mesher } from "tetrafront";
import { trimmedModelOfBrep } from "../../../wasm/dist/cad/brep-model.js";
import { drawingOf } from "../../../wasm/dist/cad/features/drawing.js";
import { evaluate } from "../../../wasm/dist/cad/features/evaluate.js";
import type { Feature, Loop } from "../../../wasm/dist/cad/features/feature.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import type { Vector } from "../../../wasm/dist/base/vectors.js";
import { readProject } from "tetrafront/project";
import { boxFeature, circleLoop, measured, polygonLoop, UPRIGHT } from "../../support/features.js";
import { testKernel } from "../../support/kernel-shapes.js";

let kernel: FeatureKernel;
let mesher: Mesher;
beforeAll(async () => {
  kernel = await testKernel();
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const operation = "new";
const box = boxFeature(1, [4, 4, 2]);
const hole: Feature = { id: 2, type: "hole", position: [2, 2, 2], axis: [0, 0, -1], diameter: 2 };
const cylinder: Feature = { id: 1, type: "cylinder", operation, ...UPRIGHT, radius: 1, height: 2 };

const drawn = (features: readonly Feature[]) => {
  const { brep, failures } = evaluate(kernel, features);
  expect(failures).toEqual([]);
  return drawingOf(trimmedModelOfBrep(brep, "solid"));
};

/** Returns the volume of a mesh of what is drawn, whose elements have a size. */
async function volumeOf({ points, lines, patches }: ReturnType<typeof drawn>, size: number): Promise<number> {
  const text = JSON.stringify({
    format: "tetrafront-project",
    version: 2,
    name: "drawn",
    meshing: { size },
    points: points.map((position, p) => ({ id: p + 1, position })),
    lines: lines.map((line, l) => ({ ...line, id: l + 1, points: line.points.map((point) => point + 1) })),
    patches: patches.map(({ type, loops }, p) => ({ id: p + 1, type, loops })),
  });
  const read = readProject(text);
  if (!read.success) throw new Error(read.errors.map(({ message }) => message).join());
  const { report } = await mesher.meshProject(read.value);
  expect(report.diagnostics.map(({ code }) => code)).toEqual([]);
  return report.volume;
}

const cone = { id: 1, type: "cone", operation, ...UPRIGHT, radius: 2 } as const;
const rounded = (...edges: readonly string[]): Feature => ({ id: 2, type: "fillet", edges, radius: 0.5 });
const CASES: readonly [string, readonly Feature[], patches: number, exact: number, tolerance: number][] = [
  ["a box", [box], 6, 6, 1e-12],
  ["a drilled box", [box, hole], 7, 7, 5e-3],
  ["a cylinder", [cylinder], 3, 3, 0.02],
  ["a frustum", [{ ...cone, topRadius: 1, height: 1 }], 3, 3, 0.02],
  ["a cone", [{ ...cone, topRadius: 0, height: 2 }], 5, 1, 0.05],
  ["a ball", [{ id: 1, type: "sphere", operation, ...UPRIGHT, radius: 1 }], 8, 0, 0.06],
  ["a ring", [{ id: 1, type: "torus", operation, ...UPRIGHT, majorRadius: 2, minorRadius: 1 }], 16, 0, 0.08],
  ["a box with a round edge", [box, rounded("1/front|1/right")], 7, 7, 0.01],
  [
    "a box with round corners",
    [box, rounded("1/front|1/right", "1/front|1/top", "1/right|1/top")],
    10,
    9,
    0.01,
  ],
  ["a cylinder with a round rim", [cylinder, rounded("1/side|1/top")], 7, 3, 0.04],
];

test.each(CASES)(
  "%s has its volume",
  async (_, features, patches, exact, tolerance) => {
    const drawing = drawn(features);
    expect(drawing.left).toEqual([]);
    const exactly = drawing.patches.filter(({ isExact }) => isExact);
    expect([drawing.patches.length, exactly.length]).toEqual([patches, exact]);
    const { volume } = measured(kernel, features);
    expect(Math.abs((await volumeOf(drawing, 0.3)) / volume - 1)).toBeLessThanOrEqual(tolerance);
  },
  120_000,
);

/** A half disc beside the axis z. */
const halfDisc: Loop = [
  {
    kind: "line",
    points: [
      [4, 0, 1],
      [4, 0, -1],
    ],
  },
  {
    kind: "arc",
    points: [
      [4, 0, -1],
      [5, 0, 0],
      [4, 0, 1],
    ],
  },
];
const hexagon = polygonLoop(
  ...[0, 1, 2, 3, 4, 5].map((k): Vector => [
    9.5 * Math.cos((k * Math.PI) / 3),
    9.5 * Math.sin((k * Math.PI) / 3),
    0,
  ]),
);
const wavy: Loop = [
  {
    kind: "spline",
    points: [
      [0, 0, 0],
      [1, 0.3, 0],
      [2, -0.3, 0],
      [3, 0, 0],
    ],
  },
  ...polygonLoop([3, 0, 0], [3, 2, 0], [0, 2, 0], [0, 0, 0]).slice(0, 3),
];
const bent: Feature = {
  id: 1,
  type: "torus",
  operation,
  ...UPRIGHT,
  majorRadius: 5,
  minorRadius: 1,
  angle: 90,
};
const revolved: Feature = {
  id: 1,
  type: "revolve",
  operation,
  ...UPRIGHT,
  profile: { outer: halfDisc },
  angle: 90,
};
const blind: Feature = {
  id: 2,
  type: "hole",
  position: [0, 4, 1.5],
  axis: [0, -1, 0],
  diameter: 0.5,
  depth: 3,
};
const UNDRAWN: readonly [string, readonly Feature[], undrawn: number][] = [
  ["a bent pipe is not a full turn", [bent], 1],
  ["edges of a half turn bound no patch that is near a round face", [revolved], 1],
  [
    "a cone with a hole in its side has no second rim",
    [{ ...cone, radius: 3, topRadius: 0, height: 6 }, blind],
    1,
  ],
];

test.each(UNDRAWN)("%s", (_, features, undrawn) => {
  expect(drawn(features).left).toHaveLength(undrawn);
});

test("the outer loop of a plane face encloses the largest area", async () => {
  const profile = { outer: circleLoop(10), holes: [hexagon] };
  const features: readonly Feature[] = [{ id: 1, type: "extrude", operation, profile, vector: [0, 0, 3] }];
  const volume = await volumeOf(drawn(features), 1);
  expect(Math.abs(volume / measured(kernel, features).volume - 1)).toBeLessThan(0.02);
});

test("faces with splines as edges are not exact", () => {
  const features: readonly Feature[] = [
    { id: 1, type: "extrude", operation, profile: { outer: wavy }, vector: [0, 0, 1] },
  ];
  const { patches, left } = drawn(features);
  expect(left).toEqual([]);
  expect(patches.filter(({ isExact }) => isExact)).toHaveLength(3);
});

test("faces that no patch fits are left, and only those", () => {
  const across: Feature = { id: 2, type: "hole", position: [-2, 0, 1], axis: [1, 0, 0], diameter: 0.5 };
  const drawing = drawn([cylinder, across]);
  const { faces } = evaluate(kernel, [cylinder, across]);
  expect(drawing.left.map((face) => faces[face])).toEqual(["1/side"]);
});

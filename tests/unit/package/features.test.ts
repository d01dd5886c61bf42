/** Lists of features evaluated by the kernel: volumes, areas, names of faces and edges, failures. */
import { beforeAll, describe, expect, test } from "vitest";

import { lengthOf, minus, pointOf } from "../../../wasm/dist/base/vectors.js";
import { triangulatedModelOfBrep } from "../../../wasm/dist/cad/brep-model.js";
import { evaluate, withShape } from "../../../wasm/dist/cad/features/evaluate.js";
import type { Feature, FeatureOf, LoopCurve } from "../../../wasm/dist/cad/features/feature.js";
import { edgeName } from "../../../wasm/dist/cad/features/named-solid.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import {
  boxFeature,
  circleLoop,
  measured,
  namesOf,
  polygonLoop,
  squareLoop,
  UPRIGHT,
} from "../../support/features.js";
import { testKernel } from "../../support/kernel-shapes.js";
import { edgeOf, surfaceAt, surfaceOf, curveAt } from "../../support/trimmed-surfaces.js";

let kernel: FeatureKernel;
beforeAll(async () => {
  kernel = (await testKernel()) as FeatureKernel;
}, 30_000);

const { PI, SQRT2, tan } = Math;
const operation = "new";
const box = boxFeature(1, [10, 20, 30]);
const BOX_AREA = 2200;
const boxNames = ["back", "bottom", "front", "left", "right", "top"].map((face) => `1/${face}`);
const line = (...points: LoopCurve & { kind: "line" } extends { points: infer P } ? [P] : never): LoopCurve => ({
  kind: "line",
  points: points[0],
});

interface Case {
  readonly features: readonly Feature[];
  readonly volume: number;
  readonly area?: number;
  readonly faces: readonly string[];
}

const drill: FeatureOf<"hole"> = {
  id: 2,
  type: "hole",
  position: [5, 5, 30],
  axis: [0, 0, -1],
  diameter: 3,
};
const corner = ["1/front|1/right", "1/front|1/top", "1/right|1/top"];

const CASES: Record<string, Case> = {
  "a box": { features: [box], volume: 6000, area: BOX_AREA, faces: boxNames },
  "a box turned in space": {
    features: [{ ...box, axis: [1, 2, 3], x: [0, 1, 0], position: [4, -2, 1] }],
    volume: 6000,
    area: BOX_AREA,
    faces: boxNames,
  },
  "a cylinder": {
    features: [{ id: 1, type: "cylinder", operation, ...UPRIGHT, axis: [1, 1, 0], radius: 2, height: 5 }],
    volume: 20 * PI,
    area: 28 * PI,
    faces: ["1/bottom", "1/side", "1/top"],
  },
  "a frustum": {
    features: [{ id: 1, type: "cone", operation, ...UPRIGHT, radius: 4, topRadius: 1, height: 4 }],
    volume: (PI * 4 * (16 + 4 + 1)) / 3,
    area: PI * (16 + 1 + 5 * 5),
    faces: ["1/bottom", "1/side", "1/top"],
  },
  "a cone": {
    features: [{ id: 1, type: "cone", operation, ...UPRIGHT, radius: 3, topRadius: 0, height: 4 }],
    volume: 12 * PI,
    area: PI * (9 + 15),
    faces: ["1/bottom", "1/side"],
  },
  "a sphere": {
    features: [{ id: 1, type: "sphere", operation, ...UPRIGHT, radius: 3 }],
    volume: 36 * PI,
    area: 36 * PI,
    faces: ["1/side"],
  },
  "a torus": {
    features: [{ id: 1, type: "torus", operation, ...UPRIGHT, majorRadius: 5, minorRadius: 2 }],
    volume: 2 * PI * PI * 5 * 4,
    area: 4 * PI * PI * 10,
    faces: ["1/side"],
  },
  "a quarter of a torus": {
    features: [{ id: 1, type: "torus", operation, ...UPRIGHT, majorRadius: 5, minorRadius: 2, angle: 90 }],
    volume: (PI * PI * 5 * 4) / 2,
    area: PI * PI * 10 + 8 * PI,
    faces: ["1/end", "1/side", "1/start"],
  },
  "a prism": {
    features: [{ id: 1, type: "prism", operation, ...UPRIGHT, sides: 6, radius: 1, height: 2 }],
    volume: 3 * Math.sqrt(3),
    area: 3 * Math.sqrt(3) + 12,
    faces: ["1/bottom", ...[1, 2, 3, 4, 5, 6].map((k) => `1/side ${k}`), "1/top"],
  },
  "a wedge": {
    features: [{ id: 1, type: "wedge", operation, ...UPRIGHT, size: [4, 2, 4], topLength: 1 }],
    volume: 20,
    area: 2 * 10 + 2 * (4 + 1 + 4 + 5),
    faces: boxNames,
  },
  "a wedge with an edge above": {
    features: [{ id: 1, type: "wedge", operation, ...UPRIGHT, size: [3, 2, 4], topLength: 0 }],
    volume: 12,
    area: 12 + 2 * (3 + 4 + 5),
    faces: boxNames.filter((name) => name !== "1/top"),
  },
  "an extruded square with holes": {
    features: [
      {
        id: 1,
        type: "extrude",
        operation,
        profile: { outer: squareLoop(0, 10), holes: [circleLoop(1, [3, 3, 0]), squareLoop(5, 7)] },
        vector: [0, 0, -5],
      },
    ],
    volume: 5 * (100 - PI - 4),
    area: 2 * (96 - PI) + 5 * (40 + 2 * PI + 8),
    faces: [
      "1/bottom",
      "1/hole 1 side",
      ...[1, 2, 3, 4].map((k) => `1/hole 2 side ${k}`),
      ...[1, 2, 3, 4].map((k) => `1/side ${k}`),
      "1/top",
    ],
  },
  "an extruded slot of lines and arcs": {
    features: [
      {
        id: 1,
        type: "extrude",
        operation,
        profile: {
          outer: [
            line([[0, 0, 0], [4, 0, 0]]),
            { kind: "arc", points: [[4, 0, 0], [5, 1, 0], [4, 2, 0]] },
            line([[4, 2, 0], [0, 2, 0]]),
            { kind: "arc", points: [[0, 2, 0], [-1, 1, 0], [0, 0, 0]] },
          ],
        },
        vector: [0, 0, 3],
      },
    ],
    volume: 3 * (8 + PI),
    area: 2 * (8 + PI) + 3 * (8 + 2 * PI),
    faces: ["1/bottom", "1/side 1", "1/side 2", "1/side 3", "1/side 4", "1/top"],
  },
  "a revolved square": {
    features: [
      {
        id: 1,
        type: "revolve",
        operation,
        profile: { outer: squareLoop(1, 3) },
        position: [0, 0, 0],
        axis: [0, 1, 0],
        angle: 90,
      },
    ],
    volume: 4 * PI,
    area: (8 * 2 * PI * 2) / 4 + 8,
    faces: ["1/end", "1/side 1", "1/side 2", "1/side 3", "1/side 4", "1/start"],
  },
  "a revolved square, all around": {
    features: [
      {
        id: 1,
        type: "revolve",
        operation,
        profile: { outer: squareLoop(1, 3) },
        position: [0, 0, 0],
        axis: [0, 1, 0],
        angle: 360,
      },
    ],
    volume: 16 * PI,
    area: 32 * PI,
    faces: ["1/side 1", "1/side 2", "1/side 3", "1/side 4"],
  },
  "a ruled loft with a hole": {
    features: [
      {
        id: 1,
        type: "loft",
        operation,
        sections: [
          { outer: squareLoop(0, 10), holes: [circleLoop(1, [5, 5, 0])] },
          { outer: squareLoop(2, 8, 8), holes: [circleLoop(1, [5, 5, 8])] },
        ],
        isRuled: true,
      },
    ],
    volume: (8 * (100 + 60 + 36)) / 3 - 8 * PI,
    faces: ["1/end", "1/hole 1 side", "1/side 1", "1/side 2", "1/side 3", "1/side 4", "1/start"],
  },
  "a swept tube with a bend": {
    features: [
      {
        id: 1,
        type: "sweep",
        operation,
        profile: { outer: circleLoop(2), holes: [circleLoop(1)] },
        path: [
          line([[0, 0, 0], [0, 0, 10]]),
          { kind: "arc", points: [[0, 0, 10], [6 - 3 * SQRT2, 0, 10 + 3 * SQRT2], [6, 0, 16]] },
        ],
      },
    ],
    volume: 3 * PI * (10 + 3 * PI),
    area: 6 * PI * (10 + 3 * PI) + 6 * PI,
    faces: ["1/end", "1/hole 1 side", "1/hole 1 side#2", "1/side", "1/side#2", "1/start"],
  },
  "a swept square with a sharp bend": {
    features: [
      {
        id: 1,
        type: "sweep",
        operation,
        profile: { outer: squareLoop(-1, 1) },
        path: [line([[0, 0, 0], [0, 0, 10]]), line([[0, 0, 10], [20, 0, 10]])],
      },
    ],
    volume: 120,
    area: 8 * 30 + 8,
    faces: [
      "1/end",
      ...[1, 2, 3, 4].flatMap((k) => [`1/side ${k}`, `1/side ${k}#2`]),
      "1/start",
    ],
  },
  "a hole through": {
    features: [box, drill],
    volume: 6000 - 67.5 * PI,
    area: BOX_AREA - 4.5 * PI + 90 * PI,
    faces: [...boxNames, "2/side"],
  },
  "a hole with counterbore and countersink": {
    features: [
      box,
      { ...drill, depth: 10, counterbore: { diameter: 5, depth: 2 }, countersink: { diameter: 4, angle: 90 } },
    ],
    // Cylinder, cone from radius 2 to 1.5 with the same height, cylinder.
    volume: 6000 - PI * (12.5 + (0.5 * (4 + 3 + 2.25)) / 3 + 2.25 * 7.5),
    faces: [...boxNames, "2/bottom", "2/counterbore", "2/counterbore floor", "2/countersink", "2/side"],
  },
  "a fillet": {
    features: [box, { id: 2, type: "fillet", edges: ["1/front|1/right"], radius: 2 }],
    volume: 6000 - 30 * (4 - PI),
    area: BOX_AREA - 30 * 4 + 30 * PI - 2 * (4 - PI),
    faces: [...boxNames, "2/fillet 1/front|1/right"],
  },
  "fillets that meet in a corner": {
    features: [box, { id: 2, type: "fillet", edges: corner, radius: 1 }],
    // A corner of a cube without an eighth of a sphere, and three edges.
    volume: 6000 - (1 - PI / 6) - (9 + 19 + 29) * (1 - PI / 4),
    faces: [...boxNames, ...[...corner, "1/front|1/right|1/top"].map((edge) => `2/fillet ${edge}`)],
  },
  "a chamfer": {
    features: [box, { id: 2, type: "chamfer", edges: ["1/front|1/right"], distance: 2 }],
    volume: 6000 - 60,
    area: BOX_AREA - 4 - 120 + 60 * SQRT2,
    faces: [...boxNames, "2/chamfer 1/front|1/right"],
  },
  "an open shell": {
    features: [box, { id: 2, type: "shell", openFaces: ["1/top"], thickness: 1 }],
    volume: 6000 - 8 * 18 * 29,
    area: BOX_AREA + 2 * 29 * 26,
    faces: [...boxNames, ...boxNames.filter((name) => name !== "1/top").map((name) => `2/inner ${name}`)],
  },
  "a closed shell": {
    features: [box, { id: 2, type: "shell", openFaces: [], thickness: 1 }],
    volume: 6000 - 8 * 18 * 28,
    area: BOX_AREA + 2 * (8 * 18 + 8 * 28 + 18 * 28),
    faces: [...boxNames, ...boxNames.map((name) => `2/inner ${name}`)],
  },
  "a motion": {
    features: [
      box,
      {
        id: 2,
        type: "move",
        translation: [1, 2, 3],
        rotation: { position: [1, 0, 0], axis: [0, 1, 1], angle: 40 },
      },
    ],
    volume: 6000,
    area: BOX_AREA,
    faces: boxNames,
  },
  "a mirror image": {
    features: [box, drill, { id: 3, type: "mirror", position: [20, 0, 0], normal: [1, 0, 0] }],
    volume: 6000 - 67.5 * PI,
    faces: [...boxNames, "2/side"],
  },
  "a mirror image and the original": {
    features: [
      box,
      drill,
      { id: 3, type: "mirror", position: [0, 0, 0], normal: [1, 0, 0], keepOriginal: true },
    ],
    volume: 12_000 - 135 * PI,
    area: 2 * (20 * 20 + 20 * 30 + 20 * 30) - 9 * PI + 180 * PI,
    // The faces beside the plane become one.
    faces: ["1/back", "1/bottom", "1/front", "1/right", "1/top", "2/side", "3/mirror 1/right", "3/mirror 2/side"],
  },
  "a row of holes": {
    features: [
      box,
      { ...drill, position: [5, 4, 30] },
      { id: 3, type: "linear-array", step: [0, 4, 0], count: 4, features: [2] },
    ],
    volume: 6000 - 4 * 67.5 * PI,
    faces: [...boxNames, "2/side", "3/2 2/side", "3/3 2/side", "3/4 2/side"],
  },
  "a row of boxes": {
    features: [box, { id: 2, type: "linear-array", step: [15, 0, 0], count: 3 }],
    volume: 18_000,
    area: 3 * BOX_AREA,
    faces: [...boxNames, ...["2/2", "2/3"].flatMap((copy) => boxNames.map((name) => `${copy} ${name}`))],
  },
  "a circle of pegs": {
    features: [
      { id: 1, type: "cylinder", operation, ...UPRIGHT, radius: 10, height: 1 },
      { id: 2, type: "cylinder", operation: "join", ...UPRIGHT, position: [7, 0, 1], radius: 1, height: 2 },
      { id: 3, type: "circular-array", ...UPRIGHT, angle: 60, count: 6, features: [2] },
    ],
    volume: 100 * PI + 12 * PI,
    area: 220 * PI + 24 * PI,
    faces: [
      "1/bottom",
      "1/side",
      "1/top",
      "2/side",
      "2/top",
      ...[2, 3, 4, 5, 6].flatMap((k) => [`3/${k} 2/side`, `3/${k} 2/top`]),
    ],
  },
  "a list of features as a tool": {
    features: [
      box,
      {
        id: 2,
        type: "boolean",
        operation: "cut",
        tool: [
          { id: 1, type: "sphere", operation, ...UPRIGHT, radius: 3 },
          { id: 2, type: "move", translation: [5, 10, 30] },
        ],
      },
    ],
    volume: 6000 - 18 * PI,
    area: BOX_AREA + 9 * PI,
    faces: [...boxNames, "2/tool 1/side"],
  },
  "a union": {
    features: [box, boxFeature(2, [10, 20, 5], [0, 0, 30], "join")],
    volume: 7000,
    area: 2 * (200 + 350 + 700),
    faces: [...boxNames.filter((name) => name !== "1/top"), "2/top"],
  },
  "an intersection": {
    features: [box, boxFeature(2, [10, 20, 30], [5, 5, 5], "intersect")],
    volume: 5 * 15 * 25,
    area: 2 * (75 + 125 + 375),
    faces: ["1/back", "1/right", "1/top", "2/bottom", "2/front", "2/left"],
  },
  "two solids": {
    features: [box, boxFeature(2, [1, 1, 1], [50, 0, 0], "new")],
    volume: 6001,
    area: BOX_AREA + 6,
    faces: [...boxNames, ...boxNames.map((name) => name.replace("1/", "2/"))],
  },
};

describe("the kernel makes", () => {
  test.each(Object.keys(CASES))("%s", (name) => {
    const { features, volume, area, faces } = CASES[name] as Case;
    const result = measured(kernel, features);
    expect(result.failures).toEqual([]);
    expect(result.volume / volume).toBeCloseTo(1, 9);
    if (area !== undefined) expect(result.area / area).toBeCloseTo(1, 9);
    expect([...result.faces].sort()).toEqual([...faces].sort());
  });

  test.each(Object.keys(CASES))("faces in the order of the written text, closed and the same twice: %s", (name) => {
    const { features } = CASES[name] as Case;
    const first = evaluate(kernel, features);
    expect(evaluate(kernel, features)).toEqual(first);
    const { model } = triangulatedModelOfBrep(first.brep, name);
    expect(model.notes).toEqual([]);
    expect(model.faces).toHaveLength(first.faces.length);
    const uses = new Map<number, string[]>();
    model.faces.forEach(({ loops }, f) => {
      for (const { edge } of loops.flat())
        if (edgeOf(model, edge).curve !== undefined)
          uses.set(edge, [...(uses.get(edge) ?? []), first.faces[f] ?? ""]);
    });
    // The edges of the text are those of the evaluation, between the same faces: so each face has its own name.
    const pairs = (all: readonly (readonly string[])[]) => all.map((names) => [...names].sort().join(" & ")).sort();
    expect(pairs([...uses.values()])).toEqual(pairs(first.edges.map(({ faces }) => faces)));
  });
});

test("solids are imported with numbered faces", () => {
  const { brep } = evaluate(kernel, [box]);
  const result = measured(kernel, [{ id: 4, type: "import", operation, brep }]);
  expect(result.volume).toBeCloseTo(6000, 9);
  expect(result.faces).toEqual([1, 2, 3, 4, 5, 6].map((k) => `4/face ${k}`));
});

test("a loft through three circles and a spline around an axis have the volume of their sections' integral", () => {
  const loft = measured(kernel, [
    {
      id: 1,
      type: "loft",
      operation,
      sections: [0, 4, 8].map((z) => ({ outer: circleLoop(2 + z / 8, [0, 0, z]) })),
    },
  ]);
  expect(loft.volume / ((PI * 8 * (4 + 6 + 9)) / 3)).toBeCloseTo(1, 4);
  const points = Array.from({ length: 32 }, (_, k) => {
    const angle = (2 * PI * k) / 32;
    return [Math.cos(angle), Math.sin(angle), 0] as const;
  });
  const spline = measured(kernel, [
    { id: 1, type: "extrude", operation, profile: { outer: [{ kind: "spline", points, isClosed: true }] }, vector: [0, 0, 2] },
  ]);
  expect(spline.volume / (2 * PI)).toBeCloseTo(1, 4);
});

/** A plate with a wall, holes, fillets and a shell; `t` changes all dimensions. */
const bracket = (t: number): Feature[] => [
  boxFeature(1, [80 + t, 40 + t, 10]),
  boxFeature(2, [10, 40 + t, 30 + t], [0, 0, 10], "join"),
  { id: 3, type: "hole", position: [70, 10, 10], axis: [0, 0, -1], diameter: 6 + t / 10 },
  { id: 4, type: "linear-array", step: [0, 20, 0], count: 2, features: [3] },
  { id: 5, type: "linear-array", step: [-40, 0, 0], count: 2, features: [3] },
  { id: 6, type: "fillet", edges: ["1/top|2/right", "2/right|2/top"], radius: 3 + t / 20 },
];

describe("names", () => {
  test("do not depend on dimensions", () => {
    const names = namesOf(kernel, bracket(0));
    expect(names).toContain("6/fillet 1/top|2/right");
    for (const t of [-5, 1, 4, 9]) {
      const result = measured(kernel, bracket(t));
      expect(result.failures).toEqual([]);
      expect([...result.faces].sort()).toEqual(names);
    }
  });

  test("remain at the same faces when dimensions change", () => {
    const centres = [0, 4].map((t) => {
      const { brep, faces } = evaluate(kernel, bracket(t));
      const { model } = triangulatedModelOfBrep(brep, "bracket");
      return new Map(
        model.faces.map((face, f) => {
          const coedge = face.loops[0]?.[0];
          if (coedge === undefined) throw new Error("a face has no loop");
          const { first } = edgeOf(model, coedge.edge);
          const [u = 0, v = 0] = curveAt(coedge.inPlane, first);
          const kind = surfaceOf(model, face).kind;
          return [faces[f], { kind, at: surfaceAt(surfaceOf(model, face), u, v) }];
        }),
      );
    });
    const [before, after] = centres;
    for (const [name, { kind }] of before ?? []) expect(after?.get(name)?.kind).toBe(kind);
  });

  test("of other faces remain when features are switched off", () => {
    const all = namesOf(kernel, bracket(0));
    const off = bracket(0).map((feature) => (feature.id === 5 || feature.id === 6 ? { ...feature, isOff: true } : feature));
    const names = namesOf(kernel, off);
    expect(names).toEqual(all.filter((name) => !/^[56]\//.test(name)));
  });

  test("remain when features change their order", () => {
    const [plate, wall, hole, ...others] = bracket(0) as [Feature, Feature, Feature, ...Feature[]];
    const names = namesOf(kernel, [plate, wall, hole, ...others]);
    expect(namesOf(kernel, [plate, hole, wall, ...others])).toEqual(names);
  });

  test("of the pieces of a split face are numbered by their places", () => {
    const slot = boxFeature(2, [20, 4, 40], [-5, 8, 25], "cut");
    const { faces, edges } = evaluate(kernel, [box, slot]);
    expect(faces.filter((name) => name.startsWith("1/top")).sort()).toEqual(["1/top", "1/top#2"]);
    const meanY = (name: string) => {
      const points = edges.find((edge) => edge.name === name)?.points ?? new Float64Array();
      return ((points[1] ?? NaN) + (points.at(-2) ?? NaN)) / 2;
    };
    expect(meanY(edgeName("1/top", "1/front"))).toBe(0);
    expect(meanY(edgeName("1/top#2", "1/back"))).toBe(20);
  });

  test("of edges distinguish several between the same faces", () => {
    const { edges } = evaluate(kernel, [
      { id: 1, type: "cylinder", operation, ...UPRIGHT, radius: 5, height: 10 },
      boxFeature(2, [20, 2, 10], [-10, 0, 0], "intersect"),
    ]);
    const names = edges.map(({ name }) => name);
    expect(new Set(names).size).toBe(names.length);
    expect(names).toContain("1/side|2/front");
    expect(names).toContain("1/side#2|2/front");
  });

  test("of edges run along the edges", () => {
    const { edges } = evaluate(kernel, [{ id: 1, type: "cylinder", operation, ...UPRIGHT, radius: 5, height: 10 }]);
    expect(edges.map(({ name }) => name).sort()).toEqual(["1/bottom|1/side", "1/side|1/side", "1/side|1/top"]);
    const top = edges.find(({ name }) => name === "1/side|1/top")?.points ?? new Float64Array();
    expect(top.length).toBeGreaterThan(3 * 20);
    for (let p = 0; p < top.length / 3; p++)
      expect(lengthOf(minus(pointOf(top, p), [0, 0, 10]))).toBeCloseTo(5, 9);
  });
});

describe("a feature that fails is left out", () => {
  const failing: Record<string, readonly [feature: Feature, message: RegExp, remedy: RegExp]> = {
    "a fillet that is too large": [
      { id: 7, type: "fillet", edges: ["1/front|1/right"], radius: 50 },
      /no such faces along the edges/,
      /smaller radius/,
    ],
    "a fillet along an edge that is not there": [
      { id: 7, type: "fillet", edges: ["1/front|9/right"], radius: 1 },
      /no edge 1\/front\|9\/right/,
      /Choose the edge again/,
    ],
    "a chamfer that is too large": [
      { id: 7, type: "chamfer", edges: ["1/front|1/right"], distance: 50 },
      /./,
      /smaller distance/,
    ],
    "a shell that is too thick": [
      { id: 7, type: "shell", openFaces: ["1/top"], thickness: 8 },
      /./,
      /smaller thickness/,
    ],
    "a shell without a face": [
      { id: 7, type: "shell", openFaces: ["3/top"], thickness: 1 },
      /no face 3\/top/,
      /Choose the face again/,
    ],
    "an intersection with nothing": [
      boxFeature(7, [1, 1, 1], [100, 0, 0], "intersect"),
      /Nothing is left/,
      /Change its size or its place/,
    ],
    "a cut of everything": [boxFeature(7, [100, 100, 100], [-1, -1, -1], "cut"), /Nothing is left/, /./],
    "a box without width": [boxFeature(7, [1, 0, 1], [0, 0, 0], "join"), /width must be a positive/, /Change the width/],
    "a length that is no number": [boxFeature(7, [1, NaN, 1], [0, 0, 0], "join"), /not finite/, /Change the number/],
    "an axis without length": [
      { id: 7, type: "cylinder", operation: "join", position: [0, 0, 0], axis: [0, 0, 0], radius: 1, height: 1 },
      /./,
      /./,
    ],
    "an open loop": [
      {
        id: 7,
        type: "extrude",
        operation: "join",
        profile: { outer: squareLoop(0, 1).slice(0, 3) },
        vector: [0, 0, 1],
      },
      /Curve 1 of a loop does not begin where/,
      /loops are closed/,
    ],
    "a loop that intersects itself": [
      {
        id: 7,
        type: "extrude",
        operation: "join",
        profile: { outer: polygonLoop([0, 0, 0], [9, 9, 0], [9, 0, 0], [0, 5, 0]) },
        vector: [0, 0, 99],
      },
      /intersect itself/,
      /do not intersect/,
    ],
    "a loop in no plane": [
      {
        id: 7,
        type: "extrude",
        operation: "join",
        profile: { outer: polygonLoop([0, 0, 0], [9, 0, 0], [9, 9, 1], [0, 9, 0]) },
        vector: [0, 0, 99],
      },
      /not in one plane/,
      /./,
    ],
    "a damaged file": [{ id: 7, type: "import", operation: "join", brep: "no shape" }, /./, /file is damaged/],
    "an array of a feature without a piece": [
      { id: 7, type: "linear-array", step: [1, 0, 0], count: 2, features: [3] },
      /Feature 3 has no piece/,
      /./,
    ],
    "a tool that fails": [
      { id: 7, type: "boolean", operation: "cut", tool: [boxFeature(1, [1, 1, -1])] },
      /In feature 1 of the tool: The height must be/,
      /Change the height/,
    ],
    "an id that occurs twice": [boxFeature(1, [99, 99, 99], [0, 0, 0], "join"), /same id/, /another id/],
  };

  test.each(Object.keys(failing))("%s", (name) => {
    const [feature, message, remedy] = failing[name] as (typeof failing)[string];
    const after = { ...drill, id: 8 };
    const expected = evaluate(kernel, [box, after]);
    const { failures, ...result } = evaluate(kernel, [box, feature, after]);
    expect(failures).toHaveLength(1);
    expect(failures[0]?.feature).toBe(feature.id);
    expect(failures[0]?.message).toMatch(message);
    expect(failures[0]?.message).toMatch(/\.$/);
    expect(failures[0]?.remedy).toMatch(remedy);
    expect({ ...result, failures: [] }).toEqual(expected);
  });

  test("and nothing is left without a first piece", () => {
    const { brep, faces, failures } = evaluate(kernel, [drill, { ...box, operation: "cut" }]);
    expect([brep, faces]).toEqual(["", []]);
    expect(failures.map(({ message }) => message)).toEqual([
      "There is no solid before it.",
      "There is no solid before it.",
    ]);
  });
});

test("a crash of the kernel is reported, and that it must not be used again", () => {
  const crashing = new Proxy(kernel, {
    get: (target, key, receiver) => {
      if (key === "BRepAlgoAPI_Cut")
        return class {
          constructor() {
            throw new WebAssembly.RuntimeError("unreachable");
          }
        };
      return Reflect.get(target, key, receiver) as unknown;
    },
  });
  const result = evaluate(crashing, [box, drill]);
  expect(result.isKernelSpent).toBe(true);
  expect(result.failures.map(({ feature }) => feature)).toEqual([2]);
  expect(result.brep).toBe("");
});

test("the shape can be triangulated before it is written", () => {
  const { result: text = "", faces } = withShape(kernel, bracket(0), (shape) => {
    new kernel.BRepMesh_IncrementalMesh(shape, 0.1, false, 0.3, false).delete();
    return kernel.BRepToolsWrapper.Write(shape);
  });
  const { triangles } = triangulatedModelOfBrep(text, "bracket");
  expect(new Set(triangles.faces).size).toBe(faces.length);
});

test("the memory of the kernel does not grow", () => {
  const bytes = () => kernel.wasmMemory.buffer.byteLength;
  const features = [...bracket(0), { id: 7, type: "fillet", edges: ["1/front|1/right"], radius: 99 } as const];
  for (let k = 0; k < 3; k++) evaluate(kernel, features);
  const before = bytes();
  for (let k = 0; k < 30; k++) evaluate(kernel, features);
  expect(bytes()).toBe(before);
});

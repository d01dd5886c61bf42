/** Lists of features with the volumes, areas and names of faces that formulas and origins give. */
import type { Vector } from "../../wasm/dist/base/vectors.js";
import type { Feature, FeatureOf, LoopCurve } from "../../wasm/dist/cad/features/feature.js";
import { boxFeature, circleLoop, polygonLoop, squareLoop, UPRIGHT } from "./features.js";

const { PI, SQRT2 } = Math;
const operation = "new";
export const box = boxFeature(1, [10, 20, 30]);
const BOX_AREA = 2200;
const boxNames = ["back", "bottom", "front", "left", "right", "top"].map((face) => `1/${face}`);
const line = (points: readonly [Vector, Vector]): LoopCurve => ({ kind: "line", points });

export interface FeatureCase {
  readonly features: readonly Feature[];
  readonly volume: number;
  readonly area?: number;
  readonly faces: readonly string[];
}

export const drill: FeatureOf<"hole"> = {
  id: 2,
  type: "hole",
  position: [5, 5, 30],
  axis: [0, 0, -1],
  diameter: 3,
};
const corner = ["1/front|1/right", "1/front|1/top", "1/right|1/top"];

export const CASES: Record<string, FeatureCase> = {
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
  "a sewn tetrahedron": {
    features: [
      {
        id: 1,
        type: "sew",
        operation,
        faces: [
          { outer: polygonLoop([0, 0, 0], [1, 0, 0], [0, 1, 0]) },
          { outer: polygonLoop([0, 0, 0], [1, 0, 0], [0, 0, 1]) },
          { outer: polygonLoop([0, 0, 0], [0, 1, 0], [0, 0, 1]) },
          { outer: polygonLoop([1, 0, 0], [0, 1, 0], [0, 0, 1]) },
        ],
      },
    ],
    volume: 1 / 6,
    area: 1.5 + Math.sqrt(3) / 2,
    faces: [1, 2, 3, 4].map((k) => `1/face ${k}`),
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
            line([
              [0, 0, 0],
              [4, 0, 0],
            ]),
            {
              kind: "arc",
              points: [
                [4, 0, 0],
                [5, 1, 0],
                [4, 2, 0],
              ],
            },
            line([
              [4, 2, 0],
              [0, 2, 0],
            ]),
            {
              kind: "arc",
              points: [
                [0, 2, 0],
                [-1, 1, 0],
                [0, 0, 0],
              ],
            },
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
          line([
            [0, 0, 0],
            [0, 0, 10],
          ]),
          {
            kind: "arc",
            points: [
              [0, 0, 10],
              [6 - 3 * SQRT2, 0, 10 + 3 * SQRT2],
              [6, 0, 16],
            ],
          },
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
        path: [
          line([
            [0, 0, 0],
            [0, 0, 10],
          ]),
          line([
            [0, 0, 10],
            [20, 0, 10],
          ]),
        ],
      },
    ],
    volume: 120,
    area: 8 * 30 + 8,
    faces: ["1/end", ...[1, 2, 3, 4].flatMap((k) => [`1/side ${k}`, `1/side ${k}#2`]), "1/start"],
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
      {
        ...drill,
        depth: 10,
        counterbore: { diameter: 5, depth: 2 },
        countersink: { diameter: 4, angle: 90 },
      },
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
    faces: [
      "1/back",
      "1/bottom",
      "1/front",
      "1/right",
      "1/top",
      "2/side",
      "3/mirror 1/right",
      "3/mirror 2/side",
    ],
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

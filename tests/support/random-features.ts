/** Random lists of features. */
import type { Vector } from "../../wasm/dist/base/vectors.js";
import { evaluate } from "../../wasm/dist/cad/features/evaluate.js";
import type { Feature, Operation, Placement } from "../../wasm/dist/cad/features/feature.js";
import type { FeatureKernel } from "../../wasm/dist/cad/features/session.js";
import { boxFeature, circleLoop, polygonLoop, squareLoop, UPRIGHT } from "./features.js";
import { randomSource } from "./random.js";

/** Random numbers of a list of features. */
class Choices {
  readonly #random: () => number;

  constructor(seed: number) {
    this.#random = randomSource(seed);
  }

  whole(below: number): number {
    return this.#random() % below;
  }

  /** A number with one decimal, so that faces often lie in the same plane. */
  size(low: number, high: number): number {
    return low + this.whole(Math.round((high - low) * 10) + 1) / 10;
  }

  position(): Vector {
    return [this.size(0, 10), this.size(0, 10), this.size(0, 10)];
  }

  of<Item>(items: readonly Item[]): Item {
    return items[this.whole(items.length)] as Item;
  }

  placement(): Placement {
    const axes: Vector[] = [
      [0, 0, 1],
      [1, 0, 0],
      [0, -1, 0],
      [1, 1, 0],
      [1, 2, 3],
    ];
    return { position: this.position(), axis: this.of(axes) };
  }
}

type Make = (choices: Choices, id: number, edges: readonly string[], faces: readonly string[]) => Feature;

const operationOf = (choices: Choices): Operation => choices.of(["join", "cut", "cut", "join", "intersect"]);

const MAKERS: readonly Make[] = [
  (c, id) => ({
    id,
    type: "box",
    operation: operationOf(c),
    ...c.placement(),
    size: [c.size(1, 9), c.size(1, 9), c.size(1, 9)],
  }),
  (c, id) => ({
    id,
    type: "cylinder",
    operation: operationOf(c),
    ...c.placement(),
    radius: c.size(0.5, 4),
    height: c.size(1, 12),
  }),
  (c, id) => ({
    id,
    type: "cone",
    operation: operationOf(c),
    ...c.placement(),
    radius: c.size(0, 4),
    topRadius: c.size(0, 3),
    height: c.size(1, 8),
  }),
  (c, id) => ({ id, type: "sphere", operation: operationOf(c), ...c.placement(), radius: c.size(1, 5) }),
  (c, id) => ({
    id,
    type: "torus",
    operation: operationOf(c),
    ...c.placement(),
    majorRadius: c.size(2, 5),
    minorRadius: c.size(0.5, 1.9),
    angle: c.of([90, 360, 360]),
  }),
  (c, id) => ({
    id,
    type: "extrude",
    operation: operationOf(c),
    profile: { outer: squareLoop(1, c.size(6, 12)), holes: [circleLoop(c.size(0.5, 1.9), [3, 3, 0])] },
    vector: [0, c.size(0, 1), c.size(1, 14)],
  }),
  (c, id) => ({
    id,
    type: "hole",
    position: [c.size(1, 9), c.size(1, 9), 10],
    axis: [0, 0, -1],
    diameter: c.size(0.5, 3),
    ...c.of([{}, { depth: 4 }, { counterbore: { diameter: 4, depth: 1 } }]),
  }),
  (c, id, edges) => ({ id, type: "fillet", edges: [c.of(edges)], radius: c.size(0.1, 2) }),
  (c, id, edges) => ({ id, type: "fillet", edges: [c.of(edges), c.of(edges)], radius: c.size(0.1, 1) }),
  (c, id, edges) => ({ id, type: "chamfer", edges: [c.of(edges)], distance: c.size(0.1, 2) }),
  (c, id, _edges, faces) => ({ id, type: "shell", openFaces: [c.of(faces)], thickness: c.size(0.1, 1) }),
  (c, id) => ({
    id,
    type: "move",
    translation: c.position(),
    rotation: { ...c.placement(), angle: c.size(0, 90) },
  }),
  (c, id) => ({
    id,
    type: "mirror",
    position: c.position(),
    normal: c.of<Vector>([
      [1, 0, 0],
      [0, 1, 1],
    ]),
    keepOriginal: c.whole(2) === 0,
  }),
  (c, id) => ({
    id,
    type: "linear-array",
    step: [c.size(1, 4), c.size(0, 3), 0],
    count: 2 + c.whole(2),
    ...(id > 2 ? { features: [id - 1] } : {}),
  }),
];

/** Returns a list whose fillets and shells refer to edges and faces of the solid before them, as a user chooses them. */
export function randomFeatures(kernel: FeatureKernel, seed: number): Feature[] {
  const choices = new Choices(seed);
  const list: Feature[] = [boxFeature(1, [choices.size(6, 12), choices.size(6, 12), 10])];
  const length = 3 + choices.whole(4);
  for (let id = 2; id <= length; id++) {
    const { edges, faces } = evaluate(kernel, list);
    const make = choices.of(MAKERS);
    list.push(
      make(
        choices,
        id,
        edges.map(({ name }) => name),
        faces,
      ),
    );
  }
  return list;
}

/** Parts as they are made: their dimensions are random, but no face is nearly tangent to another. */
const PARTS: readonly ((between: (low: number, high: number) => number) => Feature[])[] = [
  (between) => {
    const [length, width, height] = [between(20, 60), between(20, 40), between(3, 12)];
    const diameter = between(2, 6);
    const holes = [
      [diameter + 2, diameter + 2],
      [length - diameter - 2, diameter + 2],
      [length / 2, width / 2],
    ].map(([x = 0, y = 0], k): Feature => ({
      id: 2 + k,
      type: "hole",
      position: [x, y, height],
      axis: [0, 0, -1],
      diameter,
      ...(k === 2 ? { counterbore: { diameter: 1.6 * diameter, depth: 0.3 * height } } : {}),
    }));
    return [boxFeature(1, [length, width, height]), ...holes];
  },
  (between) => {
    const radius = between(10, 30);
    const bolt: Feature = {
      id: 3,
      type: "hole",
      position: [0.75 * radius, 0, between(3, 6)],
      axis: [0, 0, -1],
      diameter: between(0.1, 0.2) * radius,
    };
    return [
      { id: 1, type: "cylinder", operation: "new", ...UPRIGHT, radius, height: bolt.position[2] },
      {
        id: 2,
        type: "cylinder",
        operation: "join",
        ...UPRIGHT,
        radius: between(0.3, 0.5) * radius,
        height: between(8, 20),
      },
      bolt,
      {
        id: 4,
        type: "circular-array",
        position: [0, 0, 0],
        axis: [0, 0, 1],
        angle: 60,
        count: 6,
        features: [3],
      },
      { id: 5, type: "hole", position: [0, 0, 30], axis: [0, 0, -1], diameter: between(0.3, 0.5) * radius },
    ];
  },
  (between) => {
    const [length, height, wall, width] = [between(20, 50), between(15, 40), between(2, 6), between(10, 30)];
    const outer = polygonLoop(
      [0, 0, 0],
      [length, 0, 0],
      [length, wall, 0],
      [wall, wall, 0],
      [wall, height, 0],
      [0, height, 0],
    );
    return [
      { id: 1, type: "extrude", operation: "new", profile: { outer }, vector: [0, 0, width] },
      { id: 2, type: "fillet", edges: ["1/side 3|1/side 4"], radius: between(0.5, 4) },
      {
        id: 3,
        type: "hole",
        position: [0.6 * length, wall, width / 2],
        axis: [0, -1, 0],
        diameter: between(2, 0.4 * width),
      },
    ];
  },
  (between) => {
    const size: Vector = [between(10, 40), between(10, 40), between(8, 20)];
    return [
      boxFeature(1, size),
      {
        id: 2,
        type: "fillet",
        edges: ["1/front|1/left", "1/front|1/right", "1/back|1/left", "1/back|1/right"],
        radius: between(1, 4),
      },
      { id: 3, type: "shell", openFaces: ["1/top"], thickness: between(0.5, 0.9) },
    ];
  },
  (between) => {
    const steps = [between(8, 12), between(4, 7), between(2, 3.5)];
    let z = 0;
    return steps.map((radius, k): Feature => {
      const height = between(3, 20);
      z += height;
      return {
        id: 1 + k,
        type: "cylinder",
        operation: k === 0 ? "new" : "join",
        ...UPRIGHT,
        position: [0, 0, z - height],
        radius,
        height,
      };
    });
  },
  (between) => {
    const radius = between(5, 10);
    return [
      { id: 1, type: "sphere", operation: "new", ...UPRIGHT, radius },
      {
        id: 2,
        type: "torus",
        operation: between(0, 1) < 0.5 ? "cut" : "join",
        ...UPRIGHT,
        majorRadius: radius * between(0.9, 1.1),
        minorRadius: radius * between(0.15, 0.3),
      },
    ];
  },
  (between) => {
    const radius = between(5, 12);
    return [
      {
        id: 1,
        type: "cone",
        operation: "new",
        ...UPRIGHT,
        radius,
        topRadius: between(0.3, 0.8) * radius,
        height: between(5, 25),
      },
      {
        id: 2,
        type: "cylinder",
        operation: "cut",
        position: [0, 0, 3],
        axis: [1, between(-0.3, 0.3), 0],
        radius: between(0.1, 0.2) * radius,
        height: 40,
      },
    ];
  },
  (between) => [
    {
      id: 1,
      type: "loft",
      operation: "new",
      sections: [0, 1, 2].map((k) => ({
        outer: circleLoop(between(2, 6), [between(-1, 1), between(-1, 1), 5 * k]),
      })),
    },
  ],
  (between) => [
    {
      id: 1,
      type: "sweep",
      operation: "new",
      profile: { outer: circleLoop(between(0.5, 2)), holes: [circleLoop(between(0.2, 0.4))] },
      path: [
        {
          kind: "spline",
          points: [
            [0, 0, 0],
            [0, 0, 5],
            [between(3, 8), between(-3, 3), 12],
            [between(10, 15), 0, 15],
          ],
        },
      ],
    },
  ],
  (between) => [
    {
      id: 1,
      type: "revolve",
      operation: "new",
      profile: {
        outer: squareLoop(between(2, 4), between(6, 9)),
        holes: [circleLoop(between(0.3, 0.7), [5, 5, 0])],
      },
      position: [0, 0, 0],
      axis: [0, 1, 0],
      angle: between(60, 300),
    },
  ],
];

/** Returns a part with random dimensions. */
export function randomPart(seed: number): Feature[] {
  const random = randomSource(seed * 7919);
  const between = (low: number, high: number) => low + ((high - low) * random()) / 2 ** 32;
  return (PARTS[seed % PARTS.length] ?? (() => []))(between);
}

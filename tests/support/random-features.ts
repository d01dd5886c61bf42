/** Random lists of features. */
import type { Vector } from "../../wasm/dist/base/vectors.js";
import { evaluate } from "../../wasm/dist/cad/features/evaluate.js";
import type { Feature, Operation, Placement } from "../../wasm/dist/cad/features/feature.js";
import type { FeatureKernel } from "../../wasm/dist/cad/features/session.js";
import { boxFeature, circleLoop, squareLoop } from "./features.js";
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

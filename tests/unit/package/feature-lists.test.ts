/** Random lists of features: no exception escapes, every solid is closed, and the same list gives the same text. */
import { beforeAll, expect, test } from "vitest";

import { trimmedModelOfBrep } from "../../../wasm/dist/cad/brep-model.js";
import type { Vector } from "../../../wasm/dist/base/vectors.js";
import { evaluate } from "../../../wasm/dist/cad/features/evaluate.js";
import type { Feature, Operation, Placement } from "../../../wasm/dist/cad/features/feature.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import { boxFeature, circleLoop, squareLoop } from "../../support/features.js";
import { testKernel } from "../../support/kernel-shapes.js";
import { randomSource } from "../../support/random.js";
import { edgeOf } from "../../support/trimmed-surfaces.js";

let kernel: FeatureKernel;
beforeAll(async () => {
  kernel = await testKernel();
}, 30_000);

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

/** Makes a list whose fillets and shells refer to edges and faces of the solid before them, as a user chooses them. */
function randomList(seed: number): Feature[] {
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

const SEEDS = Array.from({ length: 100 }, (_, k) => k + 1);
let made = 0;
let failed = 0;

test.each(SEEDS)(
  "random features, seed %i",
  (seed) => {
    const list = randomList(seed * 7919);
    const result = evaluate(kernel, list);
    expect(result.isKernelSpent).toBe(false);
    expect(evaluate(kernel, structuredClone(list))).toEqual(result);
    made += list.length;
    failed += result.failures.length;
    for (const { message, remedy } of result.failures)
      for (const sentence of [message, remedy]) expect(sentence).toMatch(/^[A-Z].*\.$/);
    // No face is without an origin, and no two faces or edges have the same name.
    for (const names of [result.faces, result.edges.map(({ name }) => name)]) {
      expect(names.filter((name) => !/^\d+\/./.test(name.replace(/^\(+/, "")))).toEqual([]);
      expect(new Set(names).size).toBe(names.length);
    }
    const model = trimmedModelOfBrep(result.brep, `seed ${seed}`);
    expect(model.notes).toEqual([]);
    expect(model.faces).toHaveLength(result.faces.length);
    const uses = new Map<number, number>();
    for (const { edge } of model.faces.flatMap(({ loops }) => loops.flat()))
      if (edgeOf(model, edge).curve !== undefined) uses.set(edge, (uses.get(edge) ?? 0) + 1);
    expect([...uses.values()].filter((count) => count !== 2)).toEqual([]);
  },
  60_000,
);

test("most features of the random lists succeed", () => {
  expect(made).toBeGreaterThan(300);
  expect(failed / made).toBeLessThan(0.35);
});

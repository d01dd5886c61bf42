/** Random lists of features: no exception escapes, every solid is closed, and the same list gives the same text. */
import { beforeAll, expect, test } from "vitest";

import { trimmedModelOfBrep } from "../../../wasm/dist/cad/brep-model.js";
import { evaluate } from "../../../wasm/dist/cad/features/evaluate.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import { testKernel } from "../../support/kernel-shapes.js";
import { randomFeatures } from "../../support/random-features.js";
import { edgeOf } from "../../support/trimmed-surfaces.js";

let kernel: FeatureKernel;
beforeAll(async () => {
  kernel = await testKernel();
});

/** `tests/bench/random-solids.mjs --features` tries more lists. */
const SEEDS = Array.from({ length: 12 }, (_, k) => k + 1);
let made = 0;
let failed = 0;

test.each(SEEDS)(
  "random features, seed %i",
  (seed) => {
    const list = randomFeatures(kernel, seed * 7919);
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
  expect(made).toBeGreaterThan(3 * SEEDS.length);
  expect(failed / made).toBeLessThan(0.35);
});

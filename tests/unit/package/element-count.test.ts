/** The search for a factor on all sizes that gives a number of elements, on counts with known laws. */
import { expect, test } from "vitest";

import { COUNT_TOLERANCE, meshedToCount } from "../../../wasm/src/api/element-count.js";
import { randomSource } from "../../support/random.js";

/** Returns numbers from 0 to 1. */
function unitRandom(seed: number): () => number {
  const random = randomSource(seed);
  return () => random() / 2 ** 32;
}

/** Searches with a law instead of meshes; returns what was found, and the work: all elements that were made. */
async function search(wanted: number, law: (factor: number) => number | undefined, first = 1) {
  let work = 0;
  const shares: number[] = [];
  const found = await meshedToCount({
    wanted,
    first,
    mesh: (factor, share) => {
      const count = law(factor);
      work += count ?? 0;
      shares.push(share);
      return Promise.resolve({ factor, count, made: factor });
    },
  });
  const count = found.best.count ?? 0;
  return { ...found, count, work, shares, error: Math.abs(count / wanted - 1) };
}

test("numbers that follow volume, surface and detail are reached in few runs", async () => {
  const random = unitRandom(43);
  for (let k = 0; k < 300; k++) {
    const [volume, area, detail] = [10 ** (1 + 4 * random()), 10 ** (1 + 4 * random()), 500 * random()];
    const law = (factor: number) => Math.round(volume * factor ** -3 + area * factor ** -2 + detail);
    const wanted = Math.round(10 ** (3 + 3 * random()) + 1.2 * detail);
    const { error, runs, end, work } = await search(wanted, law, 1 + 3 * random());
    expect.soft(error, `${volume} ${area} ${detail} ${wanted}`).toBeLessThan(COUNT_TOLERANCE);
    expect.soft(end).toBe("reached");
    expect.soft(runs).toBeLessThanOrEqual(8);
    if (wanted > 50_000) expect.soft(work / wanted, `${wanted}`).toBeLessThan(12);
  }
});

test("counts that scatter by a few percent are reached too", async () => {
  const random = unitRandom(7);
  let missed = 0;
  for (let k = 0; k < 200; k++) {
    const law = (factor: number) => Math.round(2000 * factor ** -2.6 * (0.97 + 0.06 * random()));
    const wanted = Math.round(10 ** (2 + 2 * random()));
    const { error } = await search(wanted, law);
    if (error > COUNT_TOLERANCE) missed++;
  }
  expect(missed).toBeLessThan(4);
});

test.each([
  ["least", 50, (factor: number) => Math.round(2000 + 3000 * factor ** -3), 2000, 1.01],
  ["most", 1e6, (factor: number) => Math.min(80_000, Math.round(3000 * factor ** -3)), 80_000, 1],
  ["most", 1e6, (factor: number) => (factor < 0.2 ? undefined : Math.round(3000 * factor ** -3)), 375_000, 4],
] as const)("a number that cannot be reached ends with the %s", async (reason, wanted, law, limit, ratio) => {
  const { end, count, runs } = await search(wanted, law);
  expect(end).toBe(reason);
  expect(count).toBeLessThanOrEqual(limit * ratio);
  expect(count).toBeGreaterThanOrEqual(limit / ratio);
  expect(runs).toBeLessThanOrEqual(20);
});

test("a number that jumps past the wanted one ends with the nearest", async () => {
  // 6 tetrahedra per cube: 6, 48, 162, 384, 750.
  const law = (factor: number) => 6 * Math.max(1, Math.round(1 / factor)) ** 3;
  const { reachable, end, count } = await search(270, law);
  expect(reachable).toHaveLength(2);
  expect(reachable).toContain(count);
  expect(end).toBe("nearest");
  expect([162, 384]).toContain(count);
});

test("a steep part of the numbers is searched more narrowly where finer parts have no effect", async () => {
  // As of a ball of given triangles that all get larger at nearly the same factor.
  const law = (factor: number) =>
    Math.round(5000 + 63_000 / (1 + Math.exp((Math.log(factor) + 0.7) / 0.008)));
  let parts = 0;
  const found = await meshedToCount({
    wanted: 50_000,
    first: 0.4,
    hasFinerParts: true,
    mesh: (factor, _, finer) => {
      if (finer) ++parts;
      return Promise.resolve({ factor, finer, count: finer ? 68_000 : law(factor), made: undefined });
    },
  });
  expect(parts).toBeGreaterThan(0);
  expect(found.end).toBe("reached");
  expect(Math.abs((found.best.count ?? 0) / 50_000 - 1)).toBeLessThan(COUNT_TOLERANCE);
});

test("without any mesh, the first one is the result; a failed first guess is tried without a factor", async () => {
  const none = await search(100, () => undefined, 0.5);
  expect(none).toMatchObject({ end: "failed", runs: 2 });
  const coarse = await search(
    1000,
    (factor) => (factor < 0.9 ? undefined : Math.round(900 * factor ** -3)),
    0.5,
  );
  expect(coarse.count).toBeGreaterThanOrEqual(900);
});

test("a search that is ended returns the last mesh", async () => {
  let runs = 0;
  const found = await meshedToCount({
    wanted: 1e5,
    first: 1,
    mesh: (factor) => Promise.resolve({ factor, count: 100, made: ++runs }),
    isEnded: () => runs === 2,
  });
  expect(found).toMatchObject({ end: "failed", runs: 2, best: { made: 2 } });
});

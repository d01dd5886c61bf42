/** An exact repair replaces one that welded nodes, if the triangles of the remeshing are poor after the latter only. */
import { expect, test } from "vitest";

import { hasWelded, remeshedBest } from "../../../wasm/src/cli/best-repair.js";
import { InvalidInput } from "../../../wasm/src/cli/messages.js";
import type { RemeshReport } from "../../../wasm/src/cli/remeshing.js";
import { MesherError } from "../../../wasm/src/diagnostics/mesher-error.js";

type Way = "welded" | "exact";

const made = (smallestAngle: number, meanRadiusRatio = 0.9) => ({
  remesh: { smallestAngle, meanRadiusRatio, isPartial: false } as RemeshReport,
});

/** Returns the way taken, and the ways tried. */
async function taken(angles: Readonly<Record<Way, number>>, exact = () => Promise.resolve<Way>("exact")) {
  const tried: Way[] = [];
  const { prepared, isExact } = await remeshedBest<Way, ReturnType<typeof made>>("welded", exact, (way) => {
    tried.push(way);
    return Promise.resolve(made(angles[way]));
  });
  expect(isExact).toBe(prepared === "exact");
  return { prepared, tried };
}

test.each([
  ["the welded repair is good enough", { welded: 12, exact: 30 }, { prepared: "welded", tried: ["welded"] }],
  ["the exact one is better", { welded: 2, exact: 17 }, { prepared: "exact", tried: ["welded", "exact"] }],
  ["the exact one is worse", { welded: 9, exact: 4 }, { prepared: "welded", tried: ["welded", "exact"] }],
] as const)("takes the better repair: %s", async (_, angles, expected) => {
  expect(await taken(angles)).toEqual(expected);
});

test("keeps the welded repair if the exact one fails, and rejects if it is cancelled", async () => {
  const angles = { welded: 2, exact: 17 };
  const failed = new MesherError("engine-failed", "it failed", { reason: "it failed" });
  const cancelled = new MesherError("cancelled", "it was cancelled", { reason: "it was cancelled" });
  expect((await taken(angles, () => Promise.reject(failed))).prepared).toBe("welded");
  expect((await taken(angles, () => Promise.reject(new InvalidInput("a.stl", [])))).prepared).toBe("welded");
  await expect(taken(angles, () => Promise.reject(cancelled))).rejects.toBe(cancelled);
});

test("returns the first result as a partial one if the second way is stopped", async () => {
  const cancelled = new MesherError("cancelled", "it was cancelled", { reason: "it was cancelled" });
  const first = made(2);
  const stopped = {
    prepared: "welded",
    isExact: false,
    made: { remesh: { ...first.remesh, isPartial: true } },
  };
  const half = { remesh: { ...made(30).remesh, isPartial: true } };
  const exact = () => Promise.resolve<Way>("exact");
  const partial = { partial: true };
  const way = (second: () => Promise<typeof first>) => (prepared: Way) =>
    prepared === "welded" ? Promise.resolve(first) : second();
  expect(
    await remeshedBest<Way, typeof first>(
      "welded",
      exact,
      way(() => Promise.resolve(half)),
      partial,
    ),
  ).toEqual(stopped);
  expect(
    await remeshedBest<Way, typeof first>(
      "welded",
      exact,
      way(() => Promise.reject(cancelled)),
      partial,
    ),
  ).toEqual(stopped);
  expect(
    await remeshedBest<Way, typeof first>(
      "welded",
      () => Promise.reject(cancelled),
      way(() => Promise.resolve(half)),
      partial,
    ),
  ).toEqual(stopped);
});

test("only a repair that moved nodes has another way", () => {
  const points = Float64Array.of(0, 0, 0, 1, 1, 1);
  expect([0, 1e-9, 1e-4].map((repairDeviation) => hasWelded({ points }, { repairDeviation }))).toEqual([
    false,
    false,
    true,
  ]);
});

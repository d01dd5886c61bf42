/** An exact repair replaces one that welded nodes, if the triangles of the remeshing are poor after the latter only. */
import { expect, test } from "vitest";

import { hasWelded, meshedBest, remeshedBest } from "../../../wasm/src/api/best-repair.js";
import type { RemeshReport } from "../../../wasm/src/api/meshed-surface.js";
import { emptyReport } from "../../../wasm/src/api/report.js";
import { MesherError } from "../../../wasm/src/diagnostics/mesher-error.js";
import type { MeshStatus } from "../../../wasm/src/mesh/report.js";

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
  ["the exact one is worse", { welded: 4, exact: 3 }, { prepared: "welded", tried: ["welded", "exact"] }],
] as const)("takes the better repair: %s", async (_, angles, expected) => {
  expect(await taken(angles)).toEqual(expected);
});

test("keeps the welded repair if the exact one fails, and rejects if it is cancelled", async () => {
  const angles = { welded: 2, exact: 17 };
  const failed = new MesherError("engine-failed", "it failed", { reason: "it failed" });
  const cancelled = new MesherError("cancelled", "it was cancelled", { reason: "it was cancelled" });
  expect((await taken(angles, () => Promise.reject(failed))).prepared).toBe("welded");
  expect(
    (
      await taken(angles, () =>
        Promise.reject(new MesherError("invalid-input", "a.stl", { diagnostics: [] })),
      )
    ).prepared,
  ).toBe("welded");
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

/** How filling a surface ends; `failed`: the engine fails. */
type End = MeshStatus | "failed";

/** Remeshes and fills: returns the way taken, its status, and the ways filled. */
async function filledWays(angles: Readonly<Record<Way, number>>, ends: Readonly<Record<Way, End>>) {
  const filled: Way[] = [];
  const found = await meshedBest(
    "welded",
    () => Promise.resolve<Way>("exact"),
    (way) => Promise.resolve({ ...made(angles[way]), way }),
    ({ way }) => {
      filled.push(way);
      const end = ends[way];
      const failed = new MesherError("engine-failed", way, { reason: "it failed" });
      return end === "failed" ? Promise.reject(failed) : Promise.resolve({ report: emptyReport(end, []) });
    },
  );
  expect(found.isExact).toBe(found.prepared === "exact");
  return { taken: found.prepared, status: found.result.report.status, filled };
}

test.each([
  ["stalls, so the exact one is filled", "stalled", "done", "exact"],
  ["makes the engine fail", "failed", "done", "exact"],
  ["makes the engine fail, and the other stalls", "failed", "stalled", "exact"],
  ["stalls, and the other makes the engine fail", "stalled", "failed", "welded"],
  ["stalls as the other does", "stalled", "stalled", "exact"],
  ["is refused, and the other is stopped", "invalid-input", "cancelled", "exact"],
] as const)("a surface after the welding repair %s", async (_, welded, exact, taken) => {
  const found = await filledWays({ welded: 2, exact: 9 }, { welded, exact });
  expect(found).toEqual({ taken, status: { welded, exact }[taken], filled: ["welded", "exact"] });
});

test.each([
  ["is refused", "invalid-input", "done", "exact"],
  ["is refused as the other is", "invalid-input", "invalid-input", "welded"],
] as const)("a better surface after the welding repair %s", async (_, welded, exact, taken) => {
  const found = await filledWays({ welded: 4, exact: 3 }, { welded, exact });
  expect(found).toEqual({ taken, status: { welded, exact }[taken], filled: ["welded", "exact"] });
});

test("a surface that was stopped is not filled again, and the first failure is that of both ways", async () => {
  const stopped = await filledWays({ welded: 2, exact: 9 }, { welded: "cancelled", exact: "done" });
  expect(stopped).toEqual({ taken: "welded", status: "cancelled", filled: ["welded"] });
  const both = filledWays({ welded: 2, exact: 9 }, { welded: "failed", exact: "failed" });
  await expect(both).rejects.toThrow("welded");
});

/** A report of a mesh with this smallest dihedral angle; of a stalled one without. */
function meshWith(angle: number | undefined) {
  const made = emptyReport(angle === undefined ? "stalled" : "done", []);
  return { report: { ...made, dihedral: { ...made.dihedral, min: angle ?? made.dihedral.min } } };
}

test.each([
  ["fit, so nothing else is made", { welded: 2, exact: 9 }, { welded: 16, exact: 20 }, "welded", ["welded"]],
  ["unfit", { welded: 2, exact: 9 }, { welded: 3, exact: 20 }, "exact", ["welded", "exact"]],
  [
    "unfit, and those of the exact one are worse",
    { welded: 2, exact: 9 },
    { welded: 3, exact: 1 },
    "welded",
    ["welded", "exact"],
  ],
  ["missing", { welded: 2, exact: 9 }, { welded: undefined, exact: 20 }, "exact", ["welded", "exact"]],
  [
    "unfit, but its triangles are the better ones",
    { welded: 2, exact: 1 },
    { welded: 3, exact: 20 },
    "welded",
    ["welded"],
  ],
  [
    "unfit, but its triangles are not poor",
    { welded: 12, exact: 30 },
    { welded: 3, exact: 20 },
    "welded",
    ["welded"],
  ],
] as const)(
  "elements after the repair that welds are %s",
  async (_, triangles, elements, taken, expected) => {
    const filled: Way[] = [];
    const found = await meshedBest<
      Way,
      ReturnType<typeof made> & { readonly way: Way },
      ReturnType<typeof meshWith>
    >(
      "welded",
      () => Promise.resolve<Way>("exact"),
      (way) => Promise.resolve({ ...made(triangles[way]), way }),
      ({ way }) => {
        filled.push(way);
        return Promise.resolve(meshWith(elements[way]));
      },
    );
    expect(filled).toEqual(expected);
    expect([found.prepared, found.made.way, found.isExact]).toEqual([taken, taken, taken === "exact"]);
    expect(found.result).toEqual(meshWith(elements[taken]));
  },
);

test("only a repair that moved nodes has another way", () => {
  const points = Float64Array.of(0, 0, 0, 1, 1, 1);
  expect([0, 1e-9, 1e-4].map((repairDeviation) => hasWelded({ points }, { repairDeviation }))).toEqual([
    false,
    false,
    true,
  ]);
});

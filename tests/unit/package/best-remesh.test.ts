/** An automatic remeshing is one without options, and then, if its triangles are poor, one that merges details. */
import type { SurfaceRemesh } from "tetrafront";
import { expect, test } from "vitest";

import { remeshBest } from "../../../wasm/src/api/best-remesh.js";
import { MesherError } from "../../../wasm/src/diagnostics/mesher-error.js";

const poor = { smallestAngle: 1, meanRadiusRatio: 0.8, isPartial: false } as SurfaceRemesh;
const points = new Float64Array([0, 0, 0, 1, 1, 1]);

const remeshed = (second: () => Promise<SurfaceRemesh>) =>
  remeshBest(
    ({ dropDetails }) => (dropDetails === undefined ? Promise.resolve(poor) : second()),
    points,
    {},
    {},
  );

const rejecting = (code: "cancelled" | "engine-failed") => () =>
  Promise.reject(new MesherError(code, "it failed", { reason: "it failed" }));

test("keeps the first result if the second remeshing fails", async () => {
  expect(await remeshed(rejecting("engine-failed"))).toBe(poor);
});

test("rejects if the second remeshing is cancelled", async () => {
  await expect(remeshed(rejecting("cancelled"))).rejects.toMatchObject({ code: "cancelled" });
});

test("returns the better result, and the first one as partial if the second is", async () => {
  const good = { ...poor, smallestAngle: 20 };
  expect(await remeshed(() => Promise.resolve(good))).toBe(good);
  expect(await remeshed(() => Promise.resolve({ ...good, isPartial: true }))).toEqual({
    ...poor,
    isPartial: true,
  });
});

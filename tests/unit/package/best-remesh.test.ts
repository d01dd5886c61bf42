/** An automatic remeshing is one without options, and then, if its triangles are poor, one that merges details. */
import type { SurfaceRemesh } from "tetrafront";
import { expect, test } from "vitest";

import { remeshBest } from "../../../wasm/src/api/best-remesh.js";
import { MesherError } from "../../../wasm/src/diagnostics/mesher-error.js";

const poor = {
  smallestAngle: 1,
  meanRadiusRatio: 0.8,
  isPartial: false,
  tolerance: 0.1,
  deviation: 0.1,
  diagnostics: [] as SurfaceRemesh["diagnostics"],
} as SurfaceRemesh;
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
  expect(await remeshed(() => Promise.resolve(good))).toEqual(good);
  expect(await remeshed(() => Promise.resolve({ ...good, isPartial: true }))).toEqual({
    ...poor,
    isPartial: true,
  });
});

test("keeps within the tolerance what nobody has asked to merge", async () => {
  const asked: { readonly dropDetails?: number | undefined; readonly tolerance?: number | undefined }[] = [];
  const best = (deviation: number) =>
    remeshBest(
      (options) => {
        asked.push(options);
        const { dropDetails, tolerance = 0.1 } = options;
        const [code, severity] = ["deviation-above-tolerance", "warning"] as const;
        const warning = { code, severity } as SurfaceRemesh["diagnostics"][number];
        const merged = { ...poor, smallestAngle: 20, deviation, tolerance, diagnostics: [warning] };
        return Promise.resolve(dropDetails === undefined ? poor : merged);
      },
      points,
      {},
      {},
    );
  const merged = await best(0.0999);
  // The tolerance is that of the surface, which the merges use up in part.
  const { dropDetails = 0, tolerance } = asked[1] ?? {};
  expect(tolerance).toBeCloseTo(0.1 - dropDetails, 12);
  expect(dropDetails).toBeCloseTo(Math.sqrt(3) / 2500, 12);
  expect(merged).toMatchObject({ smallestAngle: 20, tolerance: 0.1, diagnostics: [] });
  expect(await best(0.1001)).toBe(poor);
});

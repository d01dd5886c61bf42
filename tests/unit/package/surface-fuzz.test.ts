/**
 * Many damaged surfaces: every run ends with a known status, and inspection, repair and meshing agree.
 */
import { createMesher, type Mesher, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { defectsOf, NO_DEFECTS } from "../../support/check-mesh.js";
import { randomSource } from "../../support/random.js";
import { boxSurface, cavitySurface, sphereSurface } from "../../support/surfaces.js";

/** `npm run fuzz` uses more. */
const RUNS = Number(process.env["TETRAFRONT_FUZZ"] ?? 60);

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const SHAPES = [boxSurface(1), boxSurface(3), sphereSurface(4), cavitySurface(6)];
const NUMBERS = [0, -0, 1, 1e-300, 1e300, NaN, Infinity, 1e30, 2 ** -100, 5e-324];

/**
 * Returns a simple surface with some coordinates and indices replaced, and triangles removed, duplicated or
 * reversed.
 */
function damaged(seed: number): SurfaceInput {
  const random = randomSource(Math.imul(seed, 0x9e3779b1));
  const below = (count: number) => random() % count;
  const shape = SHAPES[below(SHAPES.length)] ?? boxSurface(1);
  const points = shape.points.slice();
  let triangles = [...shape.triangles];
  for (let changes = below(4); changes >= 0; changes--) {
    const t = 3 * below(triangles.length / 3);
    const kind = below(7);
    if (kind === 0) points[below(points.length)] = NUMBERS[below(NUMBERS.length)] ?? 0;
    if (kind === 1) points[below(points.length)] = random() / 2 ** 32;
    if (kind === 2) triangles[below(triangles.length)] = below(points.length / 3 + 1);
    if (kind === 3) triangles = [...triangles.slice(0, t), ...triangles.slice(t + 3)];
    if (kind === 4) triangles.push(...triangles.slice(t, t + 3));
    if (kind === 5)
      triangles = [
        ...triangles.slice(0, t),
        ...triangles.slice(t, t + 3).reverse(),
        ...triangles.slice(t + 3),
      ];
    if (kind === 6) {
      const scale = 2 ** (below(60) - 30);
      points.forEach((x, i) => (points[i] = scale * x));
    }
  }
  return { points, triangles: Uint32Array.from(triangles) };
}

describe("damaged surfaces", () => {
  test(
    `${RUNS} of them end with a known status and leave the mesher usable`,
    async () => {
      const ended = new Map<string, number>();
      for (let seed = 1; seed <= RUNS; seed++) {
        const surface = damaged(seed);
        const found = await mesher.inspectSurface(surface);
        const { report, mesh } = await mesher.fillSurface(surface, { optimization: "fast" });
        ended.set(report.status, (ended.get(report.status) ?? 0) + 1);
        const label = `seed ${seed}: ${report.status}, ${report.diagnostics[0]?.message ?? ""}`;
        // A surface that passes the inspection is rejected only for its sizes.
        const codes = new Set(report.diagnostics.map(({ code }) => code));
        if (found.isFillable)
          expect(report.status === "invalid-input" && !codes.has("too-many-elements"), label).toBe(false);
        else expect(report.status, label).toBe("invalid-input");
        if (report.status === "done") expect(defectsOf(mesh, mesh), label).toEqual(NO_DEFECTS);
      }
      expect(ended.get("done") ?? 0).toBeGreaterThan(RUNS / 20);
      expect(ended.get("invalid-input") ?? 0).toBeGreaterThan(RUNS / 4);
    },
    RUNS * 1000 + 60_000,
  );

  test(
    "are repaired reproducibly, and nothing repairable is left",
    async () => {
      for (let seed = 1; seed <= RUNS; seed++) {
        const given = damaged(seed);
        const repair = () =>
          mesher.repairSurface(given, { fillHoles: 10 }).catch((failure: unknown) => failure);
        const [once, again] = [await repair(), await repair()];
        expect(again).toEqual(once);
        if (once instanceof Error) {
          expect(once).toMatchObject({ code: "invalid-input" });
          continue;
        }
        const { mesh: surface } = once as Awaited<ReturnType<Mesher["repairSurface"]>>;
        const { diagnostics } = await mesher.inspectSurface(surface);
        const remaining = new Set(diagnostics.map(({ code }) => code));
        for (const code of [
          "duplicate-triangle",
          "degenerate-triangle",
          "coincident-nodes",
          "flipped-triangle",
        ] as const) {
          expect(remaining.has(code), `seed ${seed}: ${code}`).toBe(false);
        }
      }
    },
    RUNS * 1000 + 60_000,
  );
});

/** The scores of candidates for triangles, against the order in which the engine tried them, and their parts. */
import { expect, test } from "vitest";
import { createMesher } from "tetrafront";
import { recordSurface } from "../../support/recorded-models";

test.each(["unit-cube", "s-duct", "square-to-circle"])(
  "%s: candidates are tried from the highest score to the lowest",
  async (id) => {
    const mesher = await createMesher();
    try {
      const { surface } = (await recordSurface(mesher, id)).trace;
      if (!surface) throw new Error("The trace has no lines and patches");
      let compared = 0;
      for (let state = 1; state <= surface.stepCount; state++) {
        const step = surface.stepAt(state);
        if (step?.kind !== "edge") continue;
        step.candidates.forEach(({ score, parts, isNew }, i) => {
          expect(score).toBe(parts.shape + parts.ideal + parts.distance);
          if (isNew) expect(parts).toEqual({ shape: 0, ideal: 2, distance: -0.55 });
          if (i === 0) return;
          compared++;
          expect(score, `state ${state}`).toBeLessThanOrEqual((step.candidates[i - 1]?.score ?? 0) + 1e-4);
        });
      }
      expect(compared).toBeGreaterThan(20);
    } finally {
      mesher.dispose();
    }
  },
);

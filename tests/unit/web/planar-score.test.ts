/** The scores of candidates for triangles, computed again, against the order in which the engine tried them. */
import { expect, test } from "vitest";
import { createMesher } from "tetrafront";
import { scoreOf } from "../../../web/teach/player/planar-judge";
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
        const front = step?.kind === "edge" ? surface.fronts[step.front] : undefined;
        if (step?.kind !== "edge" || !front) continue;
        const scores = step.candidates.map((candidate) => scoreOf(front, step, candidate));
        scores.forEach((score, i) => {
          if (i === 0) return;
          compared++;
          expect(score, `state ${state}`).toBeLessThanOrEqual((scores[i - 1] ?? 0) + 1e-6);
        });
      }
      expect(compared).toBeGreaterThan(20);
    } finally {
      mesher.dispose();
    }
  },
);

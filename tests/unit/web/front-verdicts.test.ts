/** The engine's verdicts on real models, against an independent check: the paper's test in doubles. */
import { expect, test } from "vitest";
import {
  crossedFaces,
  crossesFace,
  frontFace,
  isBehind,
  newElement,
  nodesOf,
  touching,
} from "../../../web/player/judge";
import { testByLayers, tolerance } from "../../../web/player/layered-test";
import { galleryProject, recordFront } from "../../support/recorded-models";

test.each(["unit-cube"])(
  "%s: accepted candidates cross nothing, and refused ones fail for the reason given",
  async (id) => {
    const trace = await recordFront(galleryProject(id));
    let crossing = 0;
    let foundByLayers = 0;
    for (let i = 1; i <= trace.stepCount; i++) {
      const step = trace.stepAt(i);
      if (step?.kind !== "advance") continue;
      for (const { node, isNew, position, verdict, culprit } of step.candidates) {
        const element = newElement(trace, step.face, position, isNew ? null : node);
        if (verdict === "behind") expect(isBehind(element), `step ${i}`).toBe(true);
        if (verdict === "accepted") expect(crossedFaces(trace, i - 1, element), `step ${i}`).toEqual([]);
        if (verdict !== "crosses") continue;
        ++crossing;
        expect(crossesFace(trace, element, culprit ?? 0, touching), `step ${i}`).toBe(true);
        // The paper's layers (a) and (b) rule out nothing that crosses; (c) leaves only common nodes to the exact signs.
        const { boxGap, minGap, shapeExcess, finds } = testByLayers(element, frontFace(trace, culprit ?? 0));
        expect(boxGap, `step ${i}`).toBeLessThanOrEqual(minGap);
        expect(shapeExcess, `step ${i}`).toBeLessThanOrEqual(tolerance);
        if (finds) ++foundByLayers;
        else expect(nodesOf(trace, culprit ?? 0).some((other) => element.nodes.includes(other))).toBe(true);
      }
    }
    expect(crossing).toBe(trace.summary().refused.crosses);
    expect(foundByLayers).toBeGreaterThan(crossing / 2);
  },
);

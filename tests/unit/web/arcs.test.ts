/** Arcs and circles as the app draws them before the engine samples them. */
import { describe, expect, it } from "vitest";
import { arcThrough, circleThrough, onArc } from "../../../web/document/arcs";
import { samplesAlong } from "../../../web/document/line-samples";
import { distance } from "../../../web/document/vectors";

describe("an arc", () => {
  it("runs from its first point over the second to the third", () => {
    const arc = arcThrough([1, 0, 2], [0, -1, 2], [-1, 0, 2]);
    if (!arc) throw new Error("no arc");
    expect(arc.angle).toBeCloseTo(Math.PI, 12);
    expect(distance(onArc(arc, 0), [1, 0, 2])).toBe(0);
    expect(distance(onArc(arc, 0.5), [0, -1, 2])).toBeLessThan(1e-12);
    expect(distance(onArc(arc, 1), [-1, 0, 2])).toBeLessThan(1e-12);
  });

  it("may be longer than half a circle", () => {
    const arc = arcThrough([1, 0, 0], [-1, 0, 0], [0, -1, 0]);
    expect(arc?.angle).toBeCloseTo(1.5 * Math.PI, 12);
  });

  it("needs three points that are not on one straight line", () => {
    expect(arcThrough([0, 0, 0], [1, 1, 1], [3, 3, 3])).toBeNull();
    expect(circleThrough([0, 0, 0], [1, 0, 0], [1, 0, 0])).toBeNull();
    expect(samplesAlong("arc", [[0, 0, 0], [1, 1, 1], [3, 3, 3]])).toHaveLength(3); // prettier-ignore
  });
});

describe("a circle", () => {
  it("begins and ends at its first point, at a constant distance from its centre", () => {
    const samples = samplesAlong("circle", [[3, 4, 1], [-5, 0, 1], [0, -5, 1], [3, 4, 1]]); // prettier-ignore
    expect(distance(samples.at(-1) ?? [0, 0, 0], [3, 4, 1])).toBeLessThan(1e-12);
    for (const position of samples) expect(distance(position, [0, 0, 1])).toBeCloseTo(5, 12);
  });
});

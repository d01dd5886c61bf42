/** Arcs and circles as the app draws them before the engine samples them. */
import { describe, expect, it } from "vitest";
import { arcThrough, circleThrough, middleOfArc, onArc } from "../../../web/document/arcs";
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

describe("the arc between two ends with a radius", () => {
  const ends = [[0, 0, 0], [2, 0, 0]] as const; // prettier-ignore

  it.each([1, 1.5, 10])(
    "has the radius %d, lies on the side of the pointer and is the shorter one",
    (radius) => {
      for (const side of [1, -1]) {
        const middle = middleOfArc(ends, radius, [0, 0, 1], [0.3, side * 5, 0]);
        const arc = middle && arcThrough(ends[0], middle, ends[1]);
        if (!middle || !arc) throw new Error("no arc");
        expect(Math.sign(middle[1])).toBe(side);
        expect(middle[2]).toBe(0);
        expect(distance(arc.centre, ends[0])).toBeCloseTo(radius, 9);
        expect(arc.angle).toBeLessThanOrEqual(Math.PI + 1e-9);
      }
    },
  );

  it("does not exist for a radius below half the distance", () => {
    expect(middleOfArc(ends, 0.99, [0, 0, 1], null)).toBeNull();
  });

  it("exists for a chord normal to the plane", () => {
    const middle = middleOfArc([[0, 0, 0], [0, 0, 2]], 1, [0, 0, 1], [3, 0, 1]); // prettier-ignore
    expect(middle?.map((x) => x + 0)).toEqual([1, 0, 1]);
    expect(middleOfArc([[0, 0, 0], [0, 0, 2]], 1, [0, 0, 1], null)).not.toBeNull(); // prettier-ignore
  });
});

describe("a circle", () => {
  it("begins and ends at its first point, at a constant distance from its centre", () => {
    const samples = samplesAlong("circle", [[3, 4, 1], [-5, 0, 1], [0, -5, 1], [3, 4, 1]]); // prettier-ignore
    expect(distance(samples.at(-1) ?? [0, 0, 0], [3, 4, 1])).toBeLessThan(1e-12);
    for (const position of samples) expect(distance(position, [0, 0, 1])).toBeCloseTo(5, 12);
  });
});

/** What typed numbers of a motion mean. */
import { describe, expect, it } from "vitest";
import { mapPosition } from "../../../web/document/transforms/affine";
import { formulaTexts, quantityPosition } from "../../../web/document/quantity-positions";
import { mapQuantities } from "../../../web/document/transforms/typed-maps";
import { principalPlane } from "../../../web/document/work-plane";
import { nextNumber, readMotion, type MotionContext } from "../../../web/tools/typed-motion";

const context: MotionContext = {
  mode: "translate",
  base: [1, 2, 3],
  point: null,
  axis: null,
  direction: null,
  frame: principalPlane("xy").frame,
  named: new Map([["r", 0.5]]),
};

/** Returns where the base, moved by (1, 0, 0), goes. */
function image(text: string, change: Partial<MotionContext> = {}): readonly number[] | string {
  const read = readMotion(text, { ...context, ...change });
  if (!read.success) return read.reason;
  return mapPosition(read.map, [2, 2, 3]).map((x) => Number(x.toFixed(12)));
}

describe("typed motions", () => {
  it("move by a distance along the axis, the direction of the drag, or x of the work plane", () => {
    expect(image("0.5")).toEqual([2.5, 2, 3]);
    expect(image("2*r", { axis: 2 })).toEqual([2, 2, 4]);
    expect(image("10", { direction: [0.6, -0.8, 0] })).toEqual([8, -6, 3]);
    expect(image("1", { frame: principalPlane("yz").frame })).toEqual([2, 3, 3]);
  });

  it("move by an offset, by length and angle, or to a place", () => {
    expect(image("@0.5,0,-1")).toEqual([2.5, 2, 2]);
    expect(image("@0.5,")).toEqual([2.5, 2, 3]);
    expect(image("5<90")).toEqual([2, 7, 3]);
    expect(image("0,0,0")).toEqual([1, 0, 0]);
  });

  it("rotate about the base, and scale from it", () => {
    expect(image("90", { mode: "rotate" })).toEqual([1, 3, 3]);
    expect(image("90", { mode: "rotate", axis: 1 })).toEqual([1, 2, 2]);
    expect(image("90", { mode: "rotate", axis: 0, direction: [0, 0, 1] })).toEqual([2, 2, 3]);
    expect(image("3", { mode: "scale" })).toEqual([4, 2, 3]);
    expect(image("3", { mode: "scale", axis: 1 })).toEqual([2, 2, 3]);
    expect(image("0.5,1,1", { mode: "scale" })).toEqual([1.5, 2, 3]);
  });

  it("keep the expressions that were typed; those of a place, for a single point only", () => {
    const texts = (text: string, change: Partial<MotionContext> = {}): readonly (string | null)[] | null => {
      const read = readMotion(text, { ...context, ...change });
      if (!read.success) throw new Error(read.reason);
      const from = quantityPosition([1, 2, 3], ["2*r", null, null]);
      return read.map.typed ? formulaTexts(mapQuantities(read.map.typed, from)) : null;
    };
    expect(texts("0.5")).toBeNull();
    expect(texts("4*r")).toEqual(["2*r+4*r", null, null]);
    expect(texts("@0,r,1")).toEqual(["2*r", "2+r", null]);
    expect(texts("r<90")).toEqual(["2*r", "2+r", null]);
    expect(texts("1,r,0")).toBeNull();
    expect(texts("1,r,0", { point: [1, 2, 3] })).toEqual(["2*r", "r", null]);
    expect(texts("60*r", { mode: "rotate", base: [0, 0, 0] })).toEqual([
      "cos(60*r)*(2*r)+2*(-sin(60*r))",
      "sin(60*r)*(2*r)+2*cos(60*r)",
      null,
    ]);
    expect(texts("r", { mode: "scale", axis: 1, base: [0, 0, 0] })).toEqual(["2*r", "2*r", null]);
  });

  it("refuse what has no meaning", () => {
    expect(image("1,2,3,4")).toBe("no-motion");
    expect(image("up")).toBe("no-motion");
    expect(image("1,2", { mode: "rotate" })).toBe("no-angle");
    for (const text of ["0", "-1", "1,1", "1,0,1", "1,1,1,1"]) expect(image(text, { mode: "scale" })).toBe("no-factor"); // prettier-ignore
  });

  it("go on to the next number by Tab, from the number of the chosen axis", () => {
    expect(nextNumber("0.5", "translate", null)).toBe("@0.5,");
    expect(nextNumber("", "translate", null)).toBe("@0,");
    expect(nextNumber("0.5", "translate", 1)).toBe("@0,0.5,");
    expect(nextNumber("@1,2", "translate", null)).toBe("@1,2,");
    expect(nextNumber("2", "scale", null)).toBe("2,");
    for (const full of ["@1,2,3", "5<30", "@1,"]) expect(nextNumber(full, "translate", null)).toBe(full);
    expect(nextNumber("30", "rotate", null)).toBe("30");
  });
});

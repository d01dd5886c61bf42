import { describe, expect, it } from "vitest";
import { areAlike, Bounds, boundsOf } from "../../../web/viewer/bounds";

const cube = boundsOf([0, 0, 0, 1, 1, 1]);

describe("areAlike", () => {
  it("holds for a body and the points that its curved lines leave a little", () => {
    expect(areAlike(cube, boundsOf([-0.05, 0, 0, 1, 1.05, 1]))).toBe(true);
  });

  it.each([
    ["moved", [1, 0, 0, 2, 1, 1]],
    ["larger", [0, 0, 0, 1.5, 1, 1]],
    ["smaller", [0.4, 0.4, 0.4, 0.6, 0.6, 0.6]],
  ])("does not hold for a box that is %s, in either order", (_, corners) => {
    const other = boundsOf(corners);
    expect(areAlike(cube, other)).toBe(false);
    expect(areAlike(other, cube)).toBe(false);
  });

  it("holds for an empty box and another empty one only", () => {
    expect(areAlike(new Bounds(), new Bounds())).toBe(true);
    expect(areAlike(new Bounds(), cube)).toBe(false);
    expect(areAlike(cube, new Bounds())).toBe(false);
  });
});

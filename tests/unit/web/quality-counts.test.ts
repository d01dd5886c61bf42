import { describe, expect, it } from "vitest";
import { rangeOfCounts, shareBetween } from "../../../web/document/quality-counts";

describe("shareBetween", () => {
  it("returns the fraction of the counts in whole bins", () => {
    expect(shareBetween([1, 2, 3, 4], 5, { from: 5, to: 15 })).toBe(0.5);
    expect(shareBetween([0, 0], 5, { from: 0, to: 10 })).toBe(0);
  });
});

describe("rangeOfCounts", () => {
  it("returns the range from the first bin with a count to the end of the last one", () => {
    expect(rangeOfCounts([0, 0, 7, 0, 1, 0], 5)).toEqual({ from: 10, to: 25 });
    expect(rangeOfCounts([3], 0.1)).toEqual({ from: 0, to: 0.1 });
  });

  it("returns null without counts", () => {
    expect(rangeOfCounts([0, 0], 5)).toBeNull();
    expect(rangeOfCounts([], 5)).toBeNull();
  });
});

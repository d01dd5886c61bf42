import type { QualityReport } from "tetrafront";
import { describe, expect, it } from "vitest";
import { shapesOf, shareBetween } from "../../../web/document/quality-counts";

describe("shareBetween", () => {
  it("returns the fraction of the counts in whole bins", () => {
    expect(shareBetween([1, 2, 3, 4], 5, { from: 5, to: 15 })).toBe(0.5);
    expect(shareBetween([0, 0], 5, { from: 0, to: 10 })).toBe(0);
  });
});

describe("shapesOf", () => {
  const shapes = (min: number) => ({ dihedral: { min, max: 140 }, radiusRatio: { min: 0.2, mean: 0.8 } });
  const quality = {
    shapes: shapes(20),
    regions: [
      { region: 3, shapes: shapes(20) },
      { region: 7, shapes: shapes(35) },
    ],
  } as unknown as QualityReport;

  it("returns the shapes of one region or of all", () => {
    expect(shapesOf(quality, 7).dihedral.min).toBe(35);
    expect(shapesOf(quality, null).dihedral.min).toBe(20);
  });
});

/** The digits of a score that a trace records in two bytes. */
import { expect, it } from "vitest";
import { recordedScores } from "../../../web/teach/player/recorded-score";
import { randomSource } from "../../support/random";

/** Returns the number that the upper two bytes of its float stand for. */
function recorded(score: number): number {
  const view = new DataView(new ArrayBuffer(4));
  view.setFloat32(0, score);
  view.setUint16(2, 0);
  return view.getFloat32(0);
}

const recordedScore = (score: number): string => recordedScores([score])[0] ?? "";

it("shows all scores of a column with the decimals that each of them has", () => {
  expect(recordedScores([1.2175, 0.17047, 0, 2.5].map(recorded))).toEqual(["1.2", "0.2", "0.0", "2.5"]);
  expect(recordedScores([1.2175, 0.17047, 0.2101, 2.5].map(recorded))).toEqual([
    "1.21",
    "0.17",
    "0.21",
    "2.50",
  ]);
  expect(recordedScores([])).toEqual([]);
});

it("shows the digits that are right, and no others", () => {
  expect(recordedScore(recorded(1.2175))).toBe("1.21");
  expect(recordedScore(recorded(0.17047))).toBe("0.170");
  expect(recordedScore(recorded(11.2))).toBe("11.2");
  expect(recordedScore(0)).toBe("0");
});

it("differs from the score by at most one and a half units of its last digit", () => {
  const random = randomSource(43);
  for (let i = 0; i < 2000; i++) {
    const score = 12 * (random() / 2 ** 32) ** 3 + 1e-3;
    const shown = recordedScore(recorded(score));
    const unit = 10 ** -(shown.split(".")[1]?.length ?? 0);
    expect(Math.abs(Number(shown) - score)).toBeLessThanOrEqual(1.5 * unit);
    // One more digit would not be right.
    expect(unit / 10).toBeLessThan(2 ** (Math.floor(Math.log2(score)) - 7));
  }
});

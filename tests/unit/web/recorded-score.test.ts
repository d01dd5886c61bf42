/** The digits of scores as a trace records them, in three bytes or, without their parts, in two. */
import { expect, it } from "vitest";
import { recordedScores, roundedParts } from "../../../web/teach/player/recorded-score";
import { randomSource } from "../../support/random";

const parts = { shape: 0, closing: 0, wedge: 0, pocket: 0, newNode: 0, height: 0 };

/** Returns the number that the upper bytes of its float stand for. */
function recorded(score: number, bytes: 2 | 3) {
  const view = new DataView(new ArrayBuffer(4));
  view.setFloat32(0, score);
  for (let i = bytes; i < 4; i++) view.setUint8(i, 0);
  return { score: view.getFloat32(0), parts: bytes === 2 ? null : parts };
}

const short = (score: number) => recorded(score, 2);
const scoreText = (score: number): string => recordedScores([short(score)])[0] ?? "";

it("shows all scores of a column with the decimals that each of them has", () => {
  expect(recordedScores([1.2175, 0.17047, 0, 2.5].map(short))).toEqual(["1.2", "0.2", "0.0", "2.5"]);
  expect(recordedScores([1.2175, 0.17047, 0.2101, 2.5].map(short))).toEqual(["1.21", "0.17", "0.21", "2.50"]);
  const long = [1.2175, 0.17047, 2.5].map((score) => recorded(score, 3));
  expect(recordedScores(long)).toEqual(["1.217", "0.170", "2.500"]);
  expect(recordedScores([])).toEqual([]);
});

it("shows the digits that are right, and no others", () => {
  expect(scoreText(1.2175)).toBe("1.21");
  expect(scoreText(0.17047)).toBe("0.170");
  expect(scoreText(11.2)).toBe("11.2");
  expect(scoreText(0)).toBe("0");
});

it.each([2, 3] as const)(
  "differs from a score of %i bytes by at most one and a half units of its last digit",
  (bytes) => {
    const random = randomSource(43);
    for (let i = 0; i < 2000; i++) {
      const score = 12 * (random() / 2 ** 32) ** 3 + 1e-3;
      const shown = recordedScores([recorded(score, bytes)])[0] ?? "";
      const unit = 10 ** -(shown.split(".")[1]?.length ?? 0);
      expect(Math.abs(Number(shown) - score)).toBeLessThanOrEqual(1.5 * unit);
      // One more digit would not be right, or not be worth reading.
      const spacing = 2 ** (Math.floor(Math.log2(score)) + 1 - 8 * (bytes - 1));
      expect(unit / 10 < spacing || unit === 1e-3).toBe(true);
    }
  },
);

it("shows parts that add up to the score as it is shown", () => {
  const random = randomSource(7);
  const number = (scale: number) => scale * (random() / 2 ** 32 - 0.5);
  for (let i = 0; i < 2000; i++) {
    const given = {
      shape: Math.abs(number(2)),
      closing: number(0.2),
      wedge: i % 2,
      pocket: 0,
      height: number(1),
    };
    const shown = roundedParts(given, 3);
    const sum = (all: Record<string, number>) => Object.values(all).reduce((total, part) => total + part, 0);
    expect(Math.round(1000 * sum(shown))).toBe(Math.round(1000 * sum(given)));
    expect(shown.pocket).toBe(0);
    for (const name of ["shape", "closing", "wedge", "height"] as const)
      expect(Math.abs(shown[name] - given[name])).toBeLessThan(1e-3);
  }
});

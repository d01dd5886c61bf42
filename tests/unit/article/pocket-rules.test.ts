/** The twisted prism of lesson 10: statements of its text by exhaustion, and exact signs against fractions. */
import { describe, expect, test } from "vitest";
import type { Position } from "../../../web/document/position";
import { bodyVolume, kernelOf, middleOf } from "../../../web/teach/article/figures/pocket/kernel";
import {
  diagonalsOf,
  facesOf,
  fillingsOf,
  seenFrom,
  trialsIn,
  volumeOf,
  type Element,
  type Face,
  type Pocket,
} from "../../../web/teach/article/figures/pocket/pocket-rules";
import { twistedPrism } from "../../../web/teach/article/figures/pocket/twisted-prism";
import { orientation } from "../../../web/teach/article/kit/orientation";

const twists = (from: number, to: number): number[] =>
  Array.from({ length: to - from + 1 }, (_none, i) => from + i);

/** A face by its corners in ascending order, and 1 or −1: whether they are in this sense. */
function signed([a, b, c]: Face): readonly [string, number] {
  const isEven = (a < b && b < c) || (b < c && c < a) || (c < a && a < b);
  return [[a, b, c].sort().join(" "), isEven ? 1 : -1];
}

/** Returns whether elements of positive volume cover a pocket once: their faces are its own, and all others cancel. */
function covers({ faces }: Pocket, elements: readonly Element[]): boolean {
  const sums = new Map<string, number>();
  const add = (face: Face, by: number): void => {
    const [key, sign] = signed(face);
    sums.set(key, (sums.get(key) ?? 0) + by * sign);
  };
  for (const face of faces) add(face, 1);
  for (const face of elements.flatMap(facesOf)) add(face, -1);
  return [...sums.values()].every((sum) => sum === 0);
}

describe("the twisted prism", () => {
  test("bends its walls inward with a positive twist: none of the 15 tetrahedra fits", () => {
    for (const twist of twists(1, 58)) {
      const pocket = twistedPrism(twist);
      const trials = trialsIn(pocket);
      expect(trials).toHaveLength(15);
      expect(new Set(trials.map(({ verdict }) => verdict)), `${twist}°`).toEqual(new Set(["outside"]));
      expect(diagonalsOf(pocket).map(({ run }) => run)).toEqual(["outside", "outside", "outside"]);
      expect(fillingsOf(pocket)).toEqual([]);
    }
  });

  // The verdicts on single tetrahedra are not used here: positive volumes and faces that cancel are enough.
  test.each([24, 0, -20])("with a twist of %d degrees, all 32 768 subsets are tried", (twist) => {
    const pocket = twistedPrism(twist);
    const elements = trialsIn(pocket).flatMap(({ element, verdict }) =>
      verdict === "flat" ? [] : [element],
    );
    const coverings = Array.from({ length: 2 ** elements.length }, (_none, bits) => bits).filter((bits) => {
      const chosen = elements.filter((_element, index) => (bits >> index) & 1);
      return chosen.length <= 8 && covers(pocket, chosen);
    });
    expect(coverings).toHaveLength(twist < 0 ? 6 : 0);
  });

  test("without a twist, three tetrahedra are flat, and twelve cross an edge", () => {
    const verdicts = trialsIn(twistedPrism(0)).map(({ verdict }) => verdict);
    expect(verdicts.filter((verdict) => verdict === "flat")).toHaveLength(3);
    expect(verdicts.filter((verdict) => verdict === "crosses")).toHaveLength(12);
  });

  test.each([-30, -20, -1])("with a twist of %d degrees, all fit, and fill it in six ways", (twist) => {
    const pocket = twistedPrism(twist);
    expect(trialsIn(pocket).every(({ verdict }) => verdict === "fits")).toBe(true);
    const fillings = fillingsOf(pocket);
    expect(fillings.map(({ length }) => length).sort()).toEqual([4, 4, 4, 5, 5, 5]);
    for (const filling of fillings) {
      const volumes = filling.map((element) =>
        volumeOf({
          corners: element.map((corner) => pocket.corners[corner] ?? [0, 0, 0]),
          faces: facesOf([0, 1, 2, 3]),
        }),
      );
      expect(volumes.reduce((sum, volume) => sum + volume, 0)).toBeCloseTo(volumeOf(pocket), 12);
    }
  });

  test("the three missing diagonals hold all corners, each once", () => {
    const ends = diagonalsOf(twistedPrism(24)).flatMap(({ ends }) => ends);
    expect(ends.sort()).toEqual([0, 1, 2, 3, 4, 5]);
  });
});

describe("the room from which all faces are seen", () => {
  const share = (twist: number): number => {
    const pocket = twistedPrism(twist);
    return bodyVolume(kernelOf(pocket)) / volumeOf(pocket);
  };

  test("is the whole pocket if it is not twisted inward, one third at 20°, less than 3 % at 40°, and nothing at 60°", () => {
    expect(share(-20)).toBeCloseTo(1, 9);
    expect(share(0)).toBeCloseTo(1, 9);
    expect(share(20)).toBeCloseTo(1 / 3, 1);
    expect(share(40)).toBeLessThan(0.03);
    expect(share(60)).toBeLessThan(1e-9);
  });

  test("agrees with exact sight at random positions", () => {
    const pocket = twistedPrism(30);
    const kernel = kernelOf(pocket);
    let [state, inside] = [46, 0];
    const random = (): number => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
    const count = 20_000;
    for (let i = 0; i < count; i++) {
      const position: Position = [random() * 1.44 - 0.72, random() * 1.44 - 0.72, random() * 1.05];
      if (!seenFrom(pocket, position).includes(false)) inside++;
    }
    expect((inside / count) * 1.44 * 1.44 * 1.05).toBeCloseTo(bodyVolume(kernel), 2);
    expect(seenFrom(pocket, middleOf(kernel))).not.toContain(false);
  });
});

describe("orientation", () => {
  const unit: readonly [Position, Position, Position] = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
  ];

  test("is 1 where three positions are counter-clockwise, and 0 in their plane", () => {
    expect(orientation(...unit, [0.2, 0.3, 1e-300])).toBe(1);
    expect(orientation(...unit, [0.2, 0.3, -1e-300])).toBe(-1);
    expect(orientation(...unit, [0.1, 0.7, 0])).toBe(0);
  });

  test("decides one last bit beside a slanted plane", () => {
    const d = [0.375, 0.75] as const;
    expect(orientation([0, 0, 0], [1, 0, 1], [0, 1, 1], [d[0], d[1], d[0] + d[1]])).toBe(0);
    const above = d[0] + d[1] + 2 ** -52; // the next double
    expect(orientation([0, 0, 0], [1, 0, 1], [0, 1, 1], [d[0], d[1], above])).toBe(1);
  });

  test("changes its sign when two positions change places", () => {
    let state = 7;
    const random = (): number => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
    for (let i = 0; i < 300; i++) {
      const [a, b, c] = [0, 1, 2].map((): Position => [random(), random(), random()]) as [
        Position,
        Position,
        Position,
      ];
      // Nearly in the plane of the others, up to rounding.
      const [u, v] = [random(), random()];
      const d = [0, 1, 2].map(
        (k) => (a[k] ?? 0) * u + (b[k] ?? 0) * v + (c[k] ?? 0) * (1 - u - v),
      ) as unknown as Position;
      const sign = orientation(a, b, c, d);
      expect(orientation(b, a, c, d) + sign).toBe(0);
      expect(orientation(c, a, b, d)).toBe(sign);
      expect(orientation(a, b, d, c) + sign).toBe(0);
    }
  });
});

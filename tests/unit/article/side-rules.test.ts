/** The division of a line in lesson 2, against the engine. */
import { readFileSync } from "node:fs";
import { fillPlane, type FilledPlane } from "tetrafront/trace";
import { describe, expect, test } from "vitest";
import {
  divide,
  settleSide,
  sideConstants,
  worstExcess,
} from "../../../web/teach/article/figures/sides/side-rules";
import { curves, lineEnd, SizeCurve } from "../../../web/teach/article/figures/sides/size-curve";

const { kStepTolerance } = sideConstants;
const named = Object.entries(curves).map(([name, knots]) => [name, new SizeCurve(knots)] as const);
const steep = [
  "steep",
  new SizeCurve([
    [0, 0.4],
    [1, 0.4],
    [1.3, 2.5],
    [4, 2.4],
    [4.3, 0.35],
    [8, 0.9],
  ]),
] as const;

/** Lets the engine divide the line from (0, 0) to (length, 0), the first of a rectangle, under the same sizes. */
async function byEngine(curve: SizeCurve, length: number): Promise<Extract<FilledPlane, { success: true }>> {
  const nodes = [...curve.knots, [length + 1, curve.sizeAt(lineEnd)] as const].flatMap(([x, size]) =>
    [-2, 2].map((y) => ({ position: [x, y] as const, size })),
  );
  const loop = [
    [0, 0],
    [length, 0],
    [length, 1],
    [0, 1],
  ] as const;
  const filled = await fillPlane([loop], { nodes }, { maxSteps: 0 });
  if (!filled.success) throw new Error(filled.message);
  return filled;
}

describe("the sides of a line", () => {
  test("have the constants of the engine", () => {
    const header = readFileSync("cpp/src/surface/rules.h", "utf8");
    for (const [name, value] of Object.entries(sideConstants)) {
      const [, text] = new RegExp(`${name} = ([\\d.e-]+);`).exec(header) ?? [];
      expect([name, Number(text)]).toEqual([name, value]);
    }
    // Numbers in the text of the lesson.
    const lesson = readFileSync("web/lessons/2.md", "utf8");
    expect(header).toContain("kMaxStep = 1.0 / 16.0;");
    expect(lesson).toContain("no step of its walk covers more than a sixteenth of the line");
    expect(lesson).toContain(`After ${sideConstants.kMaxAverages} averagings`);
    expect(lesson).toContain(`The program takes ${100 * sideConstants.kStepTolerance} %`);
  });

  // The line goes on beyond the curve, so that the engine's limit of a sixteenth of the line is not met.
  test.each([...named, steep])("under the curve %s are those of the engine's walk", async (_name, curve) => {
    const { trace } = await byEngine(curve, 16 * lineEnd);
    let compared = 0;
    for (let step = 1, from = 0; from < lineEnd; step++) {
      const station = trace.stepAt(step);
      if (station?.kind !== "station") throw new Error("The walk ended too early");
      const side = settleSide(curve, from, "middle", kStepTolerance);
      expect(side.length).toBeCloseTo(station.length, 5);
      expect(side.comparisons.length - 1).toBe(station.rounds);
      expect(side.comparisons[0]?.length).toBeCloseTo(station.startSize, 5);
      from = station.to[0];
      compared++;
    }
    expect(compared).toBeGreaterThan(3);
  });

  test.each([...named, steep])(
    "under the curve %s have the ends of the engine's division",
    async (_name, curve) => {
      const { trace } = await byEngine(curve, lineEnd);
      const division = trace.divisions[0];
      const { lambda, nodes } = divide(curve, 0, "middle", kStepTolerance);
      expect(lambda).toBeCloseTo(division?.length ?? 0, 3);
      expect(nodes.length).toBe((division?.nodes.length ?? 0) / 3);
      // The engine takes 1 / size as linear between its stations.
      nodes.forEach((node, i) => expect(Math.abs(node - (division?.nodes[3 * i] ?? 0))).toBeLessThan(0.02));
    },
  );

  test("are as long as the size at their middle, or as the size at their start", () => {
    const curve = new SizeCurve(curves["valley"] ?? []);
    const [fair, late] = [
      divide(curve, 0, "middle", kStepTolerance),
      divide(curve, 0, "start", kStepTolerance),
    ];
    expect(worstExcess(curve, fair)).toBeLessThan(1.0011);
    expect(worstExcess(curve, late)).toBeGreaterThan(1.2);
    for (const { from, length } of late.sides) expect(length).toBe(curve.sizeAt(from));
  });

  test("approach each other by half of 1 + slope / 2 per averaging", () => {
    const curve = new SizeCurve([
      [0, 0.5],
      [8, 2.5],
    ]);
    const [first, second] = settleSide(curve, 1, "middle", kStepTolerance).comparisons.map(
      ({ length, target }) => target - length,
    );
    expect((second ?? 0) / (first ?? 1)).toBeCloseTo(0.5 * (1 + 0.25 / 2), 12);
  });

  test("cover the line from its beginning to its end, with curves as readers can pull them", () => {
    let curve = new SizeCurve(curves["ramp"] ?? []);
    for (const [index, x, size] of [
      [1, 7, 0.01],
      [2, -3, 9],
      [0, 5, 2.6],
      [3, 4, 0.3],
      [4, 0, 0.3],
    ] as const) {
      curve = curve.withKnot(index, [x, size]);
      const { sides, nodes } = divide(curve, 0.7, "middle", kStepTolerance);
      expect(sides[0]?.from).toBe(0.7);
      expect(sides.at(-1)?.to).toBe(lineEnd);
      sides.slice(1).forEach(({ from }, i) => expect(from).toBe(sides[i]?.to));
      nodes.slice(1).forEach((node, i) => expect(node).toBeGreaterThan(nodes[i] ?? 0));
      expect(curve.knots[0]?.[0]).toBe(0);
    }
  });
});

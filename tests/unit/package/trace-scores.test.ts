/** Scores of the candidates of a front in space: recorded parts against shapes that are computed from the positions. */
import { createMesher } from "tetrafront";
import { readTrace, recordTrace, type Trace, type TracedCandidate } from "tetrafront/trace";
import { beforeAll, expect, test } from "vitest";
import { needleGearSurface } from "../../support/surfaces.js";

type Corners = readonly (readonly number[])[];
let trace: Trace;

beforeAll(async () => {
  const mesher = await createMesher();
  try {
    const recorded = await recordTrace(mesher, needleGearSurface(12, 0.3), { optimization: "none" });
    const read = readTrace(recorded.trace ?? new Uint8Array());
    if (!read.success) throw new Error(read.errors[0].message);
    trace = read.value;
  } finally {
    mesher.dispose();
  }
});

const minus = (a: readonly number[], b: readonly number[]) => a.map((value, i) => value - (b[i] ?? 0));
const square = (a: readonly number[]) => a.reduce((sum, value) => sum + value * value, 0);

/** 12³ (3 V)² / (sum of squared edges)³, for the volume V. */
function cubedMeanRatio(corners: Corners): number {
  const [a = [], b = [], c = [], d = []] = corners;
  const [[ux = 0, uy = 0, uz = 0], [vx = 0, vy = 0, vz = 0], [wx = 0, wy = 0, wz = 0]] = [
    minus(b, a),
    minus(c, a),
    minus(d, a),
  ] as [number[], number[], number[]];
  const six = ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx);
  const squares = corners.flatMap((p, i) => corners.slice(i + 1).map((q) => square(minus(q, p))));
  return (432 * six * six) / squares.reduce((sum, value) => sum + value, 0) ** 3;
}

function* candidates(): Generator<{
  step: number;
  base: Corners;
  candidate: TracedCandidate;
  before: TracedCandidate | undefined;
}> {
  for (let number = 1; number <= trace.stepCount; number++) {
    const step = trace.stepAt(number);
    if (step?.kind !== "advance") continue;
    const base = [...trace.faces.nodes.subarray(3 * step.face, 3 * step.face + 3)].map((node) => [
      ...trace.nodes.positions.subarray(3 * node, 3 * node + 3),
    ]);
    for (const [i, candidate] of step.candidates.entries())
      yield { step: number, base, candidate, before: step.candidates[i - 1] };
  }
}

test("parts add up to the score, and higher scores are tried first", () => {
  let seen = 0;
  for (const { step, candidate, before } of candidates()) {
    const { parts, score, isNew } = candidate;
    if (parts === null) throw new Error("no parts");
    const sum = parts.shape + parts.closing + parts.wedge + parts.pocket + parts.newNode + parts.height;
    expect(sum).toBeCloseTo(score, 12);
    if (isNew) expect([parts.closing, parts.wedge, parts.pocket]).toEqual([0, 0, 0]);
    else expect([parts.newNode, parts.height]).toEqual([0, 0]);
    expect(score, `step ${step}`).toBeLessThanOrEqual((before?.score ?? Infinity) * (1 + 2 ** -15));
    seen++;
  }
  expect(seen).toBeGreaterThan(500);
});

test("the shape is that of the element, and new nodes weigh less by the factors of the rules", () => {
  const heights = new Set<number | undefined>();
  for (const { base, candidate, step } of candidates()) {
    const { parts, position, isNew, score } = candidate;
    if (parts === null) throw new Error("no parts");
    const shape = cubedMeanRatio([...base, position]);
    expect(parts.shape, `step ${step}`).toBeCloseTo(shape, parts.pocket > 0 ? 2 : 3);
    // The positions of flat elements have too few digits.
    if (!isNew || shape < 0.1) continue;
    // In attempts at a pocket, new nodes weigh less.
    const factors = [0.85, 0.6].map((weight) => Math.cbrt(Math.sqrt(score / (shape * weight ** 3))));
    const known = [1, 0.85, 0.7, 0.55, 0.4].find((height) =>
      factors.some((f) => Math.abs(f - height) < 1e-3),
    );
    expect(known, `step ${step}`).toBeDefined();
    heights.add(known);
  }
  expect(heights.size).toBeGreaterThan(1);
});

test("a node of three faces of the front fills a pocket, one at an acute angle a wedge", () => {
  let [pockets, wedges] = [0, 0];
  for (let number = 1; number <= trace.stepCount; number++) {
    const step = trace.stepAt(number);
    if (step?.kind !== "advance") continue;
    const [last] = step.candidates.slice(-1);
    if (last?.verdict !== "accepted" || last.parts === null) continue;
    const isPocket = step.addedFaces.length === 0;
    expect(last.parts.pocket > 0, `step ${number}`).toBe(isPocket);
    pockets += Number(isPocket);
    wedges += last.parts.wedge;
  }
  expect(pockets).toBeGreaterThan(5);
  expect(wedges).toBeGreaterThan(50);
});

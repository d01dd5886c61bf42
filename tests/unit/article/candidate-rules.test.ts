/** The candidates of lesson 5: what the page ranks is what the engine has ranked. */
import { loadPlaneFront, readTrace, type Trace } from "tetrafront/trace";
import { describe, expect, test } from "vitest";
import { recordLessonTraces } from "../../../scripts/lib/lesson-traces.mjs";
import { firstStep } from "../../../web/teach/article/figures/candidates/plane-rules";
import {
  frameOf,
  ownWeights,
  partsOf,
  rankBy,
  scoreOf,
  spaceStepAt,
} from "../../../web/teach/article/figures/candidates/space-rules";
import type { PlanePoint } from "../../../web/teach/article/kit/plane-view";

const front = await loadPlaneFront();
const read = readTrace((await recordLessonTraces())["ball"] ?? new Uint8Array());
if (!read.success) throw new Error("The ball cannot be read");
const ball: Trace = read.value;

/** Polygons around a base of length 1, the same ones every time. */
function polygons(count: number): readonly (readonly PlanePoint[])[] {
  let state = 11;
  const random = (): number => (state = (state * 16807) % 2147483647) / 2147483647;
  return Array.from({ length: count }, () => {
    const others = Array.from({ length: 9 }, (_none, i): PlanePoint => {
      const angle = -0.1 + ((Math.PI + 0.2) * (i + 0.8 * random())) / 9;
      const radius = 0.35 + 1.7 * random();
      return [radius * Math.cos(angle), 0.15 + radius * Math.sin(angle)];
    });
    return [[-0.5, 0], [0.5, 0], ...others];
  });
}

describe("candidates in the plane", () => {
  test("are as many as the engine has ranked, in the order in which it tried them", () => {
    let [possible, refused] = [0, 0];
    for (const [i, corners] of polygons(400).entries()) {
      const step = firstStep(front, corners, 0.7 + 0.1 * (i % 8));
      if (typeof step === "string") continue;
      possible++;
      const { candidates } = step;
      // A new node that is refused is tried again, at a lower height.
      const names = new Set(candidates.map(({ corner }) => corner));
      expect(names.size).toBe(step.ranked);
      const scores = candidates.map(({ score }) => score);
      expect(scores).toEqual([...scores].sort((a, b) => b - a));
      for (const { parts, score } of candidates)
        expect(parts.shape + parts.ideal + parts.distance).toBeCloseTo(score, 9);
      const untried = candidates.findIndex(({ verdict }) => verdict === "not tried");
      const accepted = candidates.findIndex(({ verdict }) => verdict === "accepted");
      if (accepted >= 0 && untried >= 0) expect(untried).toBe(accepted + 1);
      refused += candidates.filter(({ culprit }) => culprit !== null).length;
    }
    expect(possible).toBeGreaterThan(200);
    expect(refused).toBeGreaterThan(20);
  });

  test("say why an impossible polygon is impossible", () => {
    const crossed: readonly PlanePoint[] = [
      [-0.5, 0],
      [0.5, 0],
      [-1, 1],
      [1, 1],
    ];
    expect(firstStep(front, crossed, 1)).toContain("cross");
  });
});

describe("candidates in space", () => {
  const steps = Array.from({ length: ball.stepCount }, (_none, k) => spaceStepAt(ball, k + 1));

  test("are as many as the engine has ranked, with the scores that it recorded, at every step", () => {
    let compared = 0;
    steps.forEach((step, k) => {
      const recorded = ball.stepAt(k + 1);
      if (!step || recorded?.kind !== "advance") return;
      expect(step.candidates.length).toBe(step.ranked);
      recorded.candidates.forEach((each, i) => {
        const candidate = step.candidates[i];
        if (!candidate) throw new Error(`Step ${k + 1} has no candidate ${i}`);
        expect(candidate.node).toBe(each.isNew ? null : each.node);
        expect(candidate.verdict).toBe(each.verdict);
        expect(scoreOf(candidate, ownWeights)).toBeCloseTo(each.score, 3);
        const parts = { ...partsOf(candidate, ownWeights) };
        for (const [name, part] of Object.entries({ ...each.parts }))
          expect(parts[name as keyof typeof parts]).toBeCloseTo(part, 3);
        compared++;
      });
      // The engine's order is that of the scores.
      const scores = step.candidates.map((candidate) => scoreOf(candidate, ownWeights));
      scores.slice(1).forEach((score, i) => expect(score).toBeLessThan((scores[i] ?? 0) + 1e-4));
    });
    expect(compared).toBeGreaterThan(1000);
  });

  test("are what the lesson says", () => {
    const advances = steps.flatMap((step) => step ?? []);
    expect(advances.length).toBe(1092);
    const takenFirst = advances.filter(({ candidates }) => candidates[0]?.verdict === "accepted");
    expect(takenFirst.length).toBe(1049);
    const [start, wedge, crossed] = [307, 476, 380].map((k) => spaceStepAt(ball, k)?.candidates ?? []);
    expect(start?.[0]?.node).toBeNull();
    expect(rankBy(start ?? [], { ...ownWeights, newNode: 0.8 })[0]?.node).not.toBeNull();
    expect(wedge?.[0]?.shape).toBeLessThan(0.1);
    expect(Math.max(...(wedge ?? []).map(({ shape }) => shape))).toBeGreaterThan(0.7);
    expect(crossed?.map(({ verdict }) => verdict).slice(0, 2)).toEqual(["crosses", "accepted"]);
  });

  test("stand above a base that lies flat in its frame", () => {
    for (const k of [1, 307, 900]) {
      const step = spaceStepAt(ball, k);
      if (!step) throw new Error(`There is no step ${k}`);
      const { to } = frameOf(step);
      for (const corner of step.base) expect(to(corner)[2]).toBeCloseTo(0, 9);
      expect(to(step.ideal)[2]).toBeGreaterThan(0.3);
    }
  });
});

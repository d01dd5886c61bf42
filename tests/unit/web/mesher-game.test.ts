/** "Be the mesher": questions and verdicts of recorded patches. */
import { createMesher } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import {
  checkChoice,
  judgeChoice,
  levels,
  nextQuestion,
  type GameLevel,
  type GameQuestion,
} from "../../../web/teach/player/mesher-game";
import { edgesAt, endsOf } from "../../../web/teach/player/planar-judge";
import { mesherGameStrings } from "../../../web/teach/strings/mesher-game";
import { expectFair } from "../../support/mesher-questions";
import { recordSurface } from "../../support/recorded-models";

let trace: Trace;
beforeAll(async () => {
  const mesher = await createMesher();
  ({ trace } = await recordSurface(mesher, "unit-cube"));
  mesher.dispose();
});

function questions(level: GameLevel): GameQuestion[] {
  const { surface } = trace;
  if (!surface) throw new Error("the trace has no patches");
  const all: GameQuestion[] = [];
  for (let at = nextQuestion(surface, 0, level); at; at = nextQuestion(surface, at.step.step, level))
    all.push(at);
  return all;
}

it.each(levels)("asks %s questions whose answer is among the choices", (level) => {
  const all = questions(level);
  expect(all.length).toBeGreaterThan(5);
  for (const question of all) {
    const { front, step } = question;
    const ends = new Set(edgesAt(front, step.step - 1).flatMap((edge) => endsOf(front, edge)));
    expectFair(question, level, { base: step.nodes, front: ends });
  }
});

it("asks the same questions in reverse when the reader goes back", () => {
  const { surface } = trace;
  if (!surface) throw new Error("the trace has no patches");
  for (const level of levels) {
    const steps = questions(level).map(({ step }) => step.step);
    const back = steps.map((step) => nextQuestion(surface, step - 2, level, -1)?.step.step);
    expect(back).toEqual([undefined, ...steps.slice(0, -1)]);
  }
});

it("gives both points for the program's choice, which our own check accepts", () => {
  for (const question of questions("medium")) {
    expect(judgeChoice(question, question.program)).toEqual({
      kind: "best",
      edges: [],
      points: 2,
      isDisputed: false,
    });
    if (question.program !== null) expect(checkChoice(question, question.program).kind).toBe("possible");
  }
});

it("gives no point for what the program refused, and names what it would break", () => {
  let judged = 0;
  for (const question of questions("hard"))
    for (const { node, isNew, verdict, culprit } of question.step.candidates) {
      if (verdict === "accepted" || isNew || node === null) continue;
      const found = judgeChoice(question, node);
      expect(found).toMatchObject({ kind: verdict, points: 0, isDisputed: false });
      if (verdict === "crosses") expect(found.edges).toContain(culprit);
      judged++;
    }
  expect(judged).toBeGreaterThan(0);
});

it.each(["behind", "crosses", "too-close", "same-node", "outside"] as const)(
  "shows the recorded verdict %s where our own check finds none",
  (verdict) => {
    const question = questions("easy").find(({ nodes, program }) => nodes.some((node) => node !== program));
    const node = question?.nodes.find(
      (other) => other !== question.program && checkChoice(question, other).kind === "possible",
    );
    if (!question || node === undefined) throw new Error("there is no such question");
    const tried = {
      node,
      isNew: false,
      plane: [0, 0],
      score: 0,
      parts: { shape: 0, ideal: 0, distance: 0 },
      verdict,
      culprit: verdict === "crosses" ? 7 : null,
    } as const;
    const refused = {
      ...question,
      step: { ...question.step, candidates: [tried, ...question.step.candidates] },
    };
    expect(judgeChoice(refused, node)).toEqual({
      kind: verdict,
      edges: verdict === "crosses" ? [7] : [],
      points: 0,
      // Seams and the box of the patch are not part of our own check.
      isDisputed: verdict !== "same-node" && verdict !== "outside",
    });
  },
);

it("gives one point for another choice that breaks nothing", () => {
  const verdicts = questions("medium").flatMap((question) =>
    question.nodes.map((node) => judgeChoice(question, node)),
  );
  const possible = verdicts.filter(({ kind }) => kind === "possible");
  expect(possible.length).toBeGreaterThan(0);
  expect(possible.every(({ points, edges }) => points === 1 && edges.length === 0)).toBe(true);
  expect(verdicts.some(({ kind }) => kind === "crosses")).toBe(true);
});

it("counts the candidates that the program refused before its choice", () => {
  for (const { refused } of questions("easy")) expect(refused).toBe(0);
  for (const { step, refused } of questions("hard")) {
    expect(refused).toBe(step.candidates.length - 1);
    expect(step.candidates.at(-1)?.verdict).toBe("accepted");
  }
  const { possible } = mesherGameStrings.verdict;
  expect(possible([], 7, 0)).toContain("chose node 7, which comes first in its ranking.");
  expect(possible([], 7, 1)).toContain("it tried 1 better-ranked candidate first and refused it.");
  expect(possible([], null, 2)).toContain(
    "a new node: it tried 2 better-ranked candidates first and refused them.",
  );
});

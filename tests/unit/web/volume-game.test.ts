/** "Be the mesher" in the volume: questions and verdicts of a recorded front. */
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import { nodesOf } from "../../../web/teach/player/judge";
import { levels, type GameLevel } from "../../../web/teach/player/mesher-game";
import {
  checkVolumeChoice,
  chosenCandidate,
  judgeVolumeChoice,
  nextVolumeQuestion,
  type VolumeQuestion,
} from "../../../web/teach/player/volume-game";
import { volumeGameStrings } from "../../../web/teach/strings/mesher-game";
import { expectFair } from "../../support/mesher-questions";
import { galleryProject, recordFront } from "../../support/recorded-models";

let trace: Trace;
beforeAll(async () => {
  trace = await recordFront(galleryProject("unit-cube"));
});

/** The first questions of a level. */
function questions(level: GameLevel): VolumeQuestion[] {
  const all: VolumeQuestion[] = [];
  for (
    let at = nextVolumeQuestion(trace, 0, level);
    at && all.length < 60;
    at = nextVolumeQuestion(trace, at.step.step, level)
  )
    all.push(at);
  return all;
}

it.each(levels)("asks %s questions whose answer is among the choices", (level) => {
  const all = questions(level);
  expect(all.length).toBeGreaterThan(5);
  for (const question of all) {
    const { face, step } = question.step;
    const front = new Set(Array.from(trace.frontAt(step - 1)).flatMap((other) => nodesOf(trace, other)));
    expectFair(question, level, { base: nodesOf(trace, face), front });
  }
});

it("gives both points for the program's choice, which our own check accepts", () => {
  for (const question of questions("medium")) {
    expect(judgeVolumeChoice(trace, question, question.program)).toMatchObject({ kind: "best", points: 2 });
    if (question.program !== null)
      expect(checkVolumeChoice(trace, question, question.program).kind).toBe("possible");
  }
});

it("gives no point for what the program refused, and names what it would break", () => {
  let judged = 0;
  for (const question of questions("hard"))
    for (const { node, isNew, verdict, culprit } of question.step.candidates) {
      if (verdict === "accepted" || isNew || node === null) continue;
      const found = judgeVolumeChoice(trace, question, node);
      expect(found).toMatchObject({ kind: verdict, points: 0, isDisputed: false });
      if (verdict === "crosses") expect(found.faces).toContain(culprit);
      judged++;
    }
  expect(judged).toBeGreaterThan(0);
});

it("gives one point for another choice that breaks nothing, and draws each choice", () => {
  const kinds = new Set<string>();
  for (const question of questions("medium"))
    for (const node of question.nodes) {
      const verdict = judgeVolumeChoice(trace, question, node);
      kinds.add(verdict.kind);
      expect(verdict.points).toBe({ best: 2, possible: 1 }[verdict.kind as string] ?? 0);
      const task = { question, answer: { node, verdict }, showsIdeal: true, choose: () => undefined };
      expect(chosenCandidate(trace, task)).toMatchObject({ node, isNew: false });
      expect(chosenCandidate(trace, { ...task, answer: null })).toBeNull();
    }
  expect([...kinds]).toEqual(expect.arrayContaining(["best", "possible", "crosses"]));
});

it("counts the candidates that the program refused before its choice", () => {
  for (const { refused } of questions("easy")) expect(refused).toBe(0);
  for (const { step, refused } of questions("hard")) {
    expect(refused).toBe(step.candidates.length - 1);
    expect(step.candidates.at(-1)?.verdict).toBe("accepted");
  }
  const { possible } = volumeGameStrings.verdict;
  expect(possible([], 7, 0)).toContain("chose node 7, which comes first in its ranking.");
  expect(possible([], 7, 1)).toContain("it tried 1 better-ranked candidate first and refused it.");
  expect(possible([], null, 2)).toContain(
    "a new node: it tried 2 better-ranked candidates first and refused them.",
  );
});

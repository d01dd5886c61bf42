/** What the lens says about steps of recovery. */
import { readFileSync } from "node:fs";
import { readProject } from "tetrafront/project";
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import { recoveryCounts } from "../../../web/teach/player/recovery-counts";
import type { Beat } from "../../../web/teach/strings/film";
import { recoverySentence } from "../../../web/teach/strings/recovery";
import { recordFront } from "../../support/recorded-models";

let trace: Trace;
beforeAll(async () => {
  const file = new URL("../../support/needles.json", import.meta.url);
  const project = readProject(readFileSync(file, "utf8"));
  if (!project.success) throw new Error(project.errors[0].message);
  trace = await recordFront(project.value);
});

const sentencesOf = (change: string): string[] =>
  Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1)).flatMap((step) =>
    step?.kind === "recovery" && step.change === change
      ? [recoverySentence(step.change, recoveryCounts(trace, step))]
      : [],
  );

it("counts the faces that a step of recovery leaves", () => {
  let steps = 0;
  for (let at = 1; at <= trace.stepCount; at++) {
    const step = trace.stepAt(at);
    if (step?.kind !== "recovery") continue;
    const { before, after } = recoveryCounts(trace, step);
    expect(before).toBe(trace.frontAt(at - 1).length);
    expect(after).toBe(trace.frontAt(at).length);
    steps++;
  }
  expect(steps).toBeGreaterThan(0);
});

it("says how a pocket is closed by a star, and how local remeshing and the exact fill go", () => {
  expect(sentencesOf("star")[0]).toMatch(
    /^The pocket has 8 faces\. It is closed by a star: 8 elements around new node [\d,]+\. The front goes from 58 to 50 faces\.$/u,
  );
  expect(sentencesOf("reopened")[0]).toContain("312 elements. 42 faces leave the front, and 254 join it.");
  expect(sentencesOf("undone")[0]).toContain("294 elements made in it are removed, and 312 put back.");
  expect(sentencesOf("exact-fill")).toEqual([
    expect.stringMatching(
      /^The pocket has 42 faces\. It is filled exactly, with 61 elements and 6 new nodes, .* The front goes from 42 faces to none: it is closed\.$/u,
    ),
  ]);
});

it("says in an early beat only what has been shown by then", () => {
  const steps = Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1));
  const said = (change: string, beat: Beat): string => {
    const step = steps.find((each) => each?.kind === "recovery" && each.change === change);
    return step?.kind === "recovery" ? recoverySentence(step.change, recoveryCounts(trace, step), beat) : "";
  };
  expect(said("star", "pocket")).toBe(
    "The front is stuck here: no element fits into this pocket of 8 faces.",
  );
  expect(said("star", "node")).toMatch(/^Inside the pocket, new node [\d,]+ sees all 8 faces:/u);
  expect(said("exact-fill", "node")).toMatch(/^The exact fill needs 6 new nodes, [\d,]+ to [\d,]+\.$/u);
  expect(said("reopened", "pocket")).not.toContain("312");
  expect(said("undone", "attempt")).not.toContain("put back");
  expect(said("star", "star")).toBe(sentencesOf("star")[0]);
});

it("says whether a reopened pocket was closed by the front alone", () => {
  const none = {
    removedFaces: 0,
    addedFaces: 0,
    removedElements: 0,
    addedElements: 0,
    nodes: [],
    before: 9,
    after: 9,
  };
  expect(recoverySentence("closed", none)).toBe(
    "The pocket that was reopened is closed. The front has 9 faces.",
  );
  const star = { ...none, removedFaces: 5, addedElements: 5, nodes: [7], before: 5, after: 0 };
  expect(recoverySentence("closed", star)).toBe(
    "The pocket that was reopened is closed: the last 5 faces by a star of 5 elements around new node 7. The front goes from 5 faces to none: it is closed.",
  );
});

/** What the app says of parameters of its address that it cannot use. */
import { expect, it } from "vitest";
import { addressProblems, showAddressProblems } from "../../../web/teach/commands/address-problems";
import { createShell } from "../../../web/session/shell";

const problemsOf = (query: string): readonly string[] => addressProblems(new URLSearchParams(query));

it.each([
  "",
  "test=1",
  "new=1",
  "model=unit-cube",
  "model=unit-cube&step=0",
  "model=unit-cube&step=-12&order=random&color=age&faces=all&elements=cut&candidate=0&beat=3&camera=1,2,3,4,5,6",
])("nothing of “%s”", (query) => {
  expect(problemsOf(query)).toEqual([]);
});

it.each([
  ["model=a&step=x", [/whole number.*“step=x”.*No front/]],
  ["model=a&step=", [/“step=”/]],
  ["model=a&step=1.5", [/“step=1.5”/]],
  ["step=3", [/“step=3” without a model.*No front/]],
  ["model=a&step=1&order=largest", [/“order=largest”.*layered.*own order/]],
  ["model=a&step=1&color=red", [/“age”, “size” or “layer”.*“color=red”.*Ages/]],
  ["model=a&step=1&faces=half", [/“inside” or “all”.*“faces=half”/]],
  ["model=a&step=1&elements=some", [/“recent”.*“elements=some”.*last 60/]],
  ["model=a&step=1&candidate=-1", [/“candidate=-1”.*decides/]],
  ["model=a&step=1&beat=0", [/beat from 1.*“beat=0”.*after the step/]],
  ["model=a&step=1&camera=1,2,3", [/six numbers.*“camera=1,2,3”.*whole model/]],
  ["model=a&step=1&color=red&candidate=z", [/color=red/, /candidate=z/]],
  ["model=a&order=random", [/“order” without a step.*No front/]],
  ["camera=1,2,3&color=age", [/“color” and “camera” without a step/]],
])("the parameters of “%s” that cannot be read, and what is shown instead", (query, expected) => {
  const problems = problemsOf(query);
  expect(problems).toHaveLength(expected.length);
  expected.forEach((pattern, i) => expect(problems[i]).toMatch(pattern));
});

it("a part of a long value only", () => {
  expect(problemsOf(`model=a&step=${"9".repeat(1000)}`).join().length).toBeLessThan(200);
});

it("all in one notice, one after the other", () => {
  const shell = createShell();
  showAddressProblems({ shell }, []);
  expect(shell.getState().notices).toEqual([]);
  showAddressProblems({ shell }, ["One.", "Two."]);
  showAddressProblems({ shell }, ["Three."]);
  expect(shell.getState().notices.map(({ key, text }) => [key, text])).toEqual([
    ["address", "One. Two. Three."],
  ]);
});

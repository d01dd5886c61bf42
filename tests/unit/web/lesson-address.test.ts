/** The open lesson and its runs in the address of the page. */
import { expect, it } from "vitest";
import { lessonIn, withLesson } from "../../../web/teach/lessons/lesson-address";

it.each([
  ["lesson=7", { number: 7, runs: [], step: null }],
  ["lesson=7&runs=first-in,random", { number: 7, runs: ["first-in", "random"], step: null }],
  ["lesson=7&runs=random, sideways,random,", { number: 7, runs: ["random"], step: null }],
  ["lesson=7&runs=strict,first-in%2Bstrict", { number: 7, runs: ["strict", "first-in+strict"], step: null }],
  [
    "lesson=7&runs=linear+unfiltered,tolerance-0,tolerance-3",
    { number: 7, runs: ["unfiltered+linear", "tolerance-0"], step: null },
  ],
  ["lesson=7&step=-12", { number: 7, runs: [], step: -12 }],
  ["lesson=7&step=x", { number: 7, runs: [], step: null }],
  ["runs=random", null],
])("%s", (query, lesson) => {
  expect(lessonIn(new URLSearchParams(query))).toEqual(lesson);
});

it("comes back from the address, which keeps what is not about lessons", () => {
  const lesson = { number: 3, runs: ["layered", "smallest-first", "random+strict+tolerance-2"] } as const;
  const address = withLesson("https://example.org/?model=cube&test=1&runs=random", lesson);
  expect(lessonIn(address.searchParams)).toEqual({ ...lesson, step: null });
  expect(address.searchParams.get("test")).toBe("1");
  expect(address.searchParams.has("model")).toBe(false);
  expect(withLesson(address.href, null).search).toBe("?test=1");
});

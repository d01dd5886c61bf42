import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import { countPlaywright, googleTestSeconds, longTests, sum } from "../../../scripts/lib/counts.mjs";

let folder: string;
beforeAll(() => {
  folder = mkdtempSync(path.join(tmpdir(), "tetrafront-counts-"));
});
afterAll(() => rmSync(folder, { recursive: true }));

const failed = { error: { message: "\u001B[31mexpected 1\u001B[39m\n  received 2" } };

function reportOf(
  tests: readonly { readonly status: string; readonly results: readonly object[] }[],
): string {
  const file = path.join(folder, "e2e.json");
  const specs = tests.map((test, i) => ({ file: "a.spec.ts", title: `test ${i + 1}`, tests: [test] }));
  writeFileSync(file, JSON.stringify({ suites: [{ suites: [{ specs }] }], errors: [] }));
  return file;
}

test("end-to-end tests that pass when repeated count as passed, and are listed with their first error", () => {
  const counts = countPlaywright(
    reportOf([
      { status: "expected", results: [{}] },
      { status: "flaky", results: [failed, {}] },
      { status: "unexpected", results: [failed, failed] },
      { status: "skipped", results: [] },
    ]),
  );
  expect(counts).toEqual({
    passed: 2,
    failed: 2,
    failures: ["a.spec.ts: test 3 (expected 1 received 2)", "a.spec.ts: test 4"],
    unstable: ["a.spec.ts: test 2 (expected 1 received 2)"],
  });
  expect(sum([counts, { passed: 1, failed: 0, failures: [] }])).toEqual({ ...counts, passed: 3 });
});

test("a missing report is a failure", () => {
  expect(countPlaywright(path.join(folder, "none.json"))).toMatchObject({ passed: 0, failed: 1 });
});

test("the longest C++ tests are those beyond a part of the time of all", () => {
  const file = path.join(folder, "cpp.json");
  const times = { a: "3.5s", b: "0.25s", c: "0.75s", d: "0.5s" };
  const suite = Object.entries(times).map(([name, time]) => ({ name, time }));
  writeFileSync(file, JSON.stringify({ testsuites: [{ name: "S", testsuite: suite }] }));
  const tests = googleTestSeconds([file, path.join(folder, "none.json")]);
  expect(tests).toHaveLength(4);
  expect(longTests(tests, 0.3)).toEqual(["S.a"]);
  expect(longTests(tests, 0.15)).toEqual(["S.c", "S.a"]);
  expect(longTests(tests, 1)).toEqual([]);
});

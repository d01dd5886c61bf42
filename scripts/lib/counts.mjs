import { existsSync, readFileSync } from "node:fs";
import path from "node:path";
import { stripVTControlCharacters } from "node:util";
import { root } from "./paths.mjs";

// Reads the reports of the test programs into `{ passed, failed, failures }`. A skipped test counts as failed,
// because it proves nothing. A missing report, for example after a crash, counts as one failure.

/** Characters of an error in the summary. */
const LONGEST_ERROR = 300;

const crashed = (what) => ({
  passed: 0,
  failed: 1,
  failures: [`${what} wrote no report: it crashed, could not start, or reached the time limit`],
});

function read(file) {
  if (!existsSync(file)) return undefined;
  try {
    return JSON.parse(readFileSync(file, "utf8"));
  } catch {
    return undefined;
  }
}

function tally(tests) {
  const bad = tests.filter((test) => !test.ok);
  return { passed: tests.length - bad.length, failed: bad.length, failures: bad.map((test) => test.name) };
}

/** Reads GoogleTest's --gtest_output=json. */
export function countGoogleTest(file) {
  const report = read(file);
  if (!report) return crashed("GoogleTest");
  const tests = report.testsuites.flatMap((suite) =>
    suite.testsuite.map((test) => ({
      name: `${suite.name}.${test.name}`,
      ok: test.result === "COMPLETED" && !test.failures,
    })),
  );
  return tally(tests);
}

/**
 * Reads the duration of each test in reports of GoogleTest.
 * @param {string[]} files
 * @returns {{ name: string, seconds: number }[]}
 */
export function googleTestSeconds(files) {
  return files.flatMap((file) =>
    (read(file)?.testsuites ?? []).flatMap((suite) =>
      suite.testsuite.map((test) => ({
        name: `${suite.name}.${test.name}`,
        seconds: Number.parseFloat(test.time),
      })),
    ),
  );
}

/**
 * Returns the names of all tests but the shortest ones, which together take `part` of the time of all.
 * @param {{ name: string, seconds: number }[]} tests
 * @param {number} part
 */
export function longTests(tests, part) {
  let left = part * tests.reduce((total, { seconds }) => total + seconds, 0);
  return tests
    .toSorted((a, b) => a.seconds - b.seconds)
    .filter(({ seconds }) => (left -= seconds) < 0)
    .map(({ name }) => name);
}

/** Reads vitest's JSON report; a file that does not load is one failure. */
export function countVitest(file) {
  const report = read(file);
  if (!report) return crashed("vitest");
  const tests = report.testResults.flatMap((result) =>
    result.assertionResults.length === 0 && result.status !== "passed"
      ? [{ name: `${path.relative(root, result.name)} does not load`, ok: false }]
      : result.assertionResults.map((test) => ({ name: test.fullName, ok: test.status === "passed" })),
  );
  return tally(tests);
}

/**
 * Reads Playwright's JSON report; errors outside tests, for example of the web server, are failures too. `unstable` lists
 * the tests that failed first and passed when they were repeated.
 */
export function countPlaywright(file) {
  const report = read(file);
  if (!report) return crashed("Playwright");
  const specs = (suite) => [...(suite.specs ?? []), ...(suite.suites ?? []).flatMap(specs)];
  const tests = report.suites.flatMap(specs).flatMap((spec) =>
    spec.tests.map(({ status, results }) => ({
      name: `${spec.file}: ${spec.title}${firstError(results)}`,
      ok: status === "expected" || status === "flaky",
      isUnstable: status === "flaky",
    })),
  );
  const outside = report.errors.map((error) => ({
    name: error.message ?? "an error outside the tests",
    ok: false,
  }));
  const unstable = tests.filter((test) => test.isUnstable).map((test) => test.name);
  return { ...tally([...tests, ...outside]), unstable };
}

/** The first error of a test in one line, without the colours of a terminal. */
function firstError(results) {
  const message = results.find(({ error }) => error?.message !== undefined)?.error.message;
  if (message === undefined) return "";
  const lines = stripVTControlCharacters(message).split("\n");
  return ` (${lines
    .map((line) => line.trim())
    .join(" ")
    .slice(0, LONGEST_ERROR)})`;
}

export function sum(counts) {
  return counts.reduce(
    (all, one) => ({
      passed: all.passed + one.passed,
      failed: all.failed + one.failed,
      failures: [...all.failures, ...one.failures],
      unstable: [...all.unstable, ...(one.unstable ?? [])],
    }),
    { passed: 0, failed: 0, failures: [], unstable: [] },
  );
}

/** The public face of the package is the stored one (docs/api): a change of it shows in the diff. `npm run api` stores it. */
import { readFileSync } from "node:fs";
import path from "node:path";

import * as root from "tetrafront";
import * as project from "tetrafront/project";
import * as trace from "tetrafront/trace";
import { expect, test } from "vitest";

import { apiReport, promisedEntries, reportFolder } from "../../../scripts/lib/api-report.mjs";

test.each(Object.keys(promisedEntries))("%s exports what its report says", (name) => {
  const stored = readFileSync(path.join(reportFolder, `${name}.api.md`), "utf8");
  expect(apiReport(name as keyof typeof promisedEntries)).toBe(stored);
});

test("no entry exports the types of another library", () => {
  for (const name of Object.keys(promisedEntries)) {
    const stored = readFileSync(path.join(reportFolder, `${name}.api.md`), "utf8");
    expect(stored).not.toMatch(/from '(?!\.)/);
  }
});

test("no name is exported by two entries", () => {
  const names = [root, project, trace].flatMap((entry) => Object.keys(entry));
  expect(new Set(names).size).toBe(names.length);
});

/** Remedies of problems in the app: they name no options of the command line and no calls. */
import { readFileSync } from "node:fs";

import { type Diagnostic, MesherError } from "tetrafront";
import { expect, test } from "vitest";

import { bodyProblems, toProblems } from "../../../web/document/validate";
import { emptyProject } from "../../../web/document/create";
import { failureText } from "../../../web/session/failure-text";
import { remedyInApp } from "../../../web/strings";

const OPTION_OR_CALL = /--[a-z]|`[a-zA-Z]/;

/** Returns the codes whose sentences in a file name an option or a call. */
function codesIn(file: string, begin: RegExp): string[] {
  const text = readFileSync(new URL(`../../../wasm/src/${file}`, import.meta.url), "utf8");
  const [, ...entries] = text.split(begin);
  const codes: string[] = [];
  for (let i = 0; i + 1 < entries.length; i += 2) {
    const [code = "", entry = ""] = entries.slice(i);
    const sentences = entry.replace(/^\s*(\/\/|\/?\*).*$/gm, "");
    if (OPTION_OR_CALL.test(sentences)) codes.push(code);
  }
  return codes;
}

const codes = [
  ...codesIn("diagnostics/sentences.ts", /^ {2}"?([a-z-]+)"?: \{$/m),
  "near-nodes",
  "needle-surface",
  "poor-elements",
  "cracked-surface",
  "divided-surface",
  "replaced-surface",
] as Diagnostic["code"][];

test("the package names options and calls in some remedies", () => {
  expect(codes).toContain("coarse-surface");
  expect(codes).toContain("open-edge");
});

test.each(codes)("the app has a remedy of its own for %s", (code) => {
  const remedy = remedyInApp({ code, remedy: "Use `option: 1` or `call()`.", body: 1 });
  expect(remedy).not.toMatch(OPTION_OR_CALL);
});

test.each(codes)("the app names no option for %s if it is not about one body", (code) => {
  expect(remedyInApp({ code, remedy: "Use `option: 1` or `call()`." })).not.toMatch(OPTION_OR_CALL);
});

test("problems of runs and of bodies have these remedies", () => {
  const coarse = {
    code: "coarse-surface",
    severity: "warning",
    message: "a",
    remedy: 'Use `surface: "remesh"`.',
    entities: [],
    data: { triangles: 1, lengthRatio: 3 },
  } as const;
  const project = emptyProject("a");
  expect(toProblems(project, [coarse]).map(({ remedy }) => remedy)).toEqual([
    "Select Remesh or Refine for the body, or use larger elements.",
  ]);
  const body = { id: 1, surface: "keep", points: "", triangles: "", patches: [] } as unknown as Parameters<
    typeof bodyProblems
  >[0];
  const open = { ...coarse, code: "open-edge", remedy: "Use `weld`.", data: { count: 1 } } as const;
  const inspection = { diagnostics: [open] } as unknown as Parameters<typeof bodyProblems>[1];
  expect(bodyProblems(body, inspection)[0]?.remedy).toMatch(/^Repair the surface/);
});

test("failures of calls have these remedies", () => {
  const failed = {
    code: "open-edge",
    severity: "error",
    message: "It is open",
    remedy: "Use `weld`.",
    entities: [],
    body: 1,
    data: { count: 1 },
  } as const;
  const failure = new MesherError("invalid-input", "It is open. Use `weld`.", { diagnostics: [failed] });
  expect(failureText(failure)).toMatch(/^It is open\. Repair the surface/);
  expect(failureText(new Error("lost"))).toBe("lost");
  expect(failureText("lost")).toBe("lost");
});

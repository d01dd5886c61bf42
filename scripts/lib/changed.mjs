// Selects the suites, and the tests in them, that a change can break, for `npm test -- changed`.
import { existsSync } from "node:fs";
import { inRoot } from "./paths.mjs";
import { output } from "./run.mjs";

/**
 * Returns the files that differ from the commit where this branch left `main`, including new files; on `main`
 * itself, from the parent commit.
 */
export function changedFiles() {
  const base =
    output("git", ["merge-base", "HEAD", "origin/main"])?.trim() ||
    output("git", ["merge-base", "HEAD", "main"])?.trim() ||
    "HEAD";
  const list = (args) => (output("git", args) ?? "").split("\n").filter(Boolean);
  const sinceBase = list(["diff", "--name-only", "--diff-filter=d", base]);
  const sinceParent =
    sinceBase.length === 0 ? list(["diff", "--name-only", "--diff-filter=d", "HEAD~1"]) : [];
  const untracked = list(["ls-files", "--others", "--exclude-standard"]);
  return [...new Set([...sinceBase, ...sinceParent, ...untracked])].filter((file) =>
    existsSync(inRoot(file)),
  );
}

/** Checks that meshes have the same fingerprints in Node as natively. */
const NATIVE_TEST = "tests/unit/package/native.test.ts";
/** From these files the package's types, enums, limits and defaults are generated. */
const GENERATING = /^cpp\/(include|src\/geom\/coordinates\.h)|^wasm\/.*\.(h|cpp|txt)$/;
/** Shortest test of the whole application. */
const SMOKE_SPEC = "tests/e2e/meshing.spec.ts";

/**
 * Returns the suites that `files` can break, each with the tests to run in it (`undefined`: all).
 * Other tests may break too: `npm test` runs all of them.
 */
export function suitesFor(files) {
  const touches = (pattern) => files.some((file) => pattern.test(file));
  const pick = (pattern) => files.filter((file) => pattern.test(file));
  const suites = new Map();
  if (files.length > 0) suites.set("format", undefined);
  if (touches(/\.(ts|tsx|mjs)$/)) {
    suites.set("types", undefined);
    suites.set("lint", pick(/\.(ts|tsx|mjs)$/));
  }
  const generates = touches(GENERATING);
  if (generates) suites.set("types", undefined);
  const engine = touches(/^cpp\/(src|include|CMakeLists)/);
  if (engine || touches(/^tests\/(cpp|support)\/.*\.(cpp|h)$/)) suites.set("cpp", undefined);
  if (engine) suites.set("tidy", undefined).set("alone", undefined);

  const unit = new Set(pick(/^tests\/unit\/.*\.test\.tsx?$/));
  if (generates || touches(/^wasm\//)) unit.add("tests/unit/package");
  else if (engine) unit.add(NATIVE_TEST);
  if (touches(/^web\//)) unit.add("tests/unit/web");
  if (touches(/^(public\/)?models\//)) unit.add("tests/unit/gallery");
  if (touches(/^scripts\//)) unit.add("tests/unit/scripts");
  if (unit.size > 0) suites.set("unit", [...unit]);

  const specs = new Set(pick(/^tests\/e2e\/.*\.spec\.ts$/));
  if (touches(/^web\//)) specs.add(SMOKE_SPEC);
  if (specs.size > 0) suites.set("e2e", [...specs]);
  return suites;
}

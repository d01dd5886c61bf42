import { readdirSync, readFileSync } from "node:fs";
import { defineConfig } from "vitest/config";
import { inRoot } from "./scripts/lib/paths.mjs";
import { pythonProgram } from "./scripts/lib/python.mjs";

const FOLDER = "tests/unit";
const isTest = (name) => /\.test\.tsx?$/.test(name);

/**
 * What a test file names if it changes what the files of one process share (modules, globals, the page, the clock, the environment),
 * or installs the package. Reading the environment changes nothing.
 */
const NEEDS_OWN_PROCESS = [
  /\bvi\.(?!fn\b)|@vitest-environment/,
  /\bprocess\.(?!env\[|execPath\b|platform\b)|\bglobalThis\b|\bprototype\b/,
  /\bfreshInstall\b|\/scripts\/lib\//,
];
function sharesProcess(file) {
  const text = readFileSync(inRoot(file), "utf8");
  return !NEEDS_OWN_PROCESS.some((pattern) => pattern.test(text));
}

/**
 * Test files that share a process with others, one after the other: importing the application or the package takes longer than most
 * of their tests. A new import takes a second of processor time for each file; a new engine, command line or CAD kernel takes another
 * one, most of it until V8 has optimized their code.
 */
const sharing = readdirSync(inRoot(FOLDER), { recursive: true })
  .map((name) => `${FOLDER}/${name.replaceAll("\\", "/")}`)
  .filter((file) => isTest(file) && sharesProcess(file));
/** Whether a file tests the application; the others test the package, and the examples. */
const testsApplication = (file) => /^tests\/unit\/(article|web)\//.test(file);

/** Unit tests run in Node and load the compiled engine as users do. */
export default defineConfig({
  test: {
    environment: "node",
    env: { TETRAFRONT_PYTHON: pythonProgram() },
    // Only a hang takes so long, also on a machine that is small and busy. Longer limits would hide which test hangs: the tests
    // after it in its file wait for the same engine, each up to the limit.
    testTimeout: 180_000,
    hookTimeout: 180_000,
    // Each worker holds an engine of its own.
    maxWorkers: 2,
    projects: [
      {
        extends: true,
        test: {
          name: "application, shared process",
          include: sharing.filter(testsApplication),
          isolate: false,
        },
      },
      {
        extends: true,
        test: {
          name: "package, shared process",
          include: sharing.filter((file) => !testsApplication(file)),
          isolate: false,
        },
      },
      {
        extends: true,
        test: {
          name: "own process",
          include: ["tests/unit/**/*.test.{ts,tsx}"],
          exclude: sharing,
        },
      },
    ],
  },
});

import { readdirSync, readFileSync } from "node:fs";
import { defineConfig } from "vitest/config";
import { inRoot } from "./scripts/lib/paths.mjs";
import { pythonProgram } from "./scripts/lib/python.mjs";

const FOLDER = "tests/unit";
const isTest = (name) => /\.test\.tsx?$/.test(name);

/**
 * What a test file names if it changes what the files of one process share (modules, globals, the page, the clock, the environment),
 * starts programs, or needs much memory.
 */
const NEEDS_OWN_PROCESS = [
  /\bvi\.(?!fn\b)|@vitest-environment/,
  /\bprocess\.|\bglobalThis\b|\bprototype\b|\bchild_process\b/,
  /\btestKernel\b|\bkernelSolids\b|\btemporaryFolder\b|\bnativeProgram\b|\bfreshInstall\b|\/scripts\/lib\//,
];
/** Tests of the package start engines, which tests of the application seldom do. */
const STARTS_ENGINES = /\bcreateMesher\b|\brecordFront\b|\bmesher\b/i;

function sharesProcess(file) {
  const text = readFileSync(inRoot(file), "utf8");
  if (!file.startsWith(`${FOLDER}/web/`) && STARTS_ENGINES.test(text)) return false;
  return !NEEDS_OWN_PROCESS.some((pattern) => pattern.test(text));
}

/**
 * Test files that share a process with others, one after the other: importing the application or the package takes longer than most
 * of their tests. A new import takes a second of processor time for each file.
 */
const sharing = readdirSync(inRoot(FOLDER), { recursive: true })
  .map((name) => `${FOLDER}/${name.replaceAll("\\", "/")}`)
  .filter((file) => isTest(file) && sharesProcess(file));

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
      { extends: true, test: { name: "shared process", include: sharing, isolate: false } },
      {
        extends: true,
        test: { name: "own process", include: ["tests/unit/**/*.test.{ts,tsx}"], exclude: sharing },
      },
    ],
  },
});

import { existsSync, mkdirSync, rmSync } from "node:fs";
import { createServer } from "node:net";
import path from "node:path";
import { formatCpp, formatScript } from "../format.mjs";
import { wrongIncludes } from "./arrows.mjs";
import { wrongCoroutines } from "./coroutines.mjs";
import { countGoogleTest, countPlaywright, countVitest, sum } from "./counts.mjs";
import { fuzzSurfaces } from "./fuzzer.mjs";
import { untestedOracles } from "./oracles.mjs";
import { buildFolders, inRoot, reports } from "./paths.mjs";
import { inParallel, jobs, run } from "./run.mjs";
import { tidy } from "./tidy.mjs";
import { findFuzzer } from "./tools.mjs";

const bin = (name) => inRoot("node_modules", ".bin", name);
const report = (name) => path.join(reports, `${name}.json`);

/** Longer with `npm run fuzz`. */
const FUZZ_SECONDS = 60;

/** A static check counts as one test. */
const check = (ok, name) => ({ passed: ok ? 1 : 0, failed: ok ? 0 : 1, failures: ok ? [] : [name] });

/** Some tests take long; with more parts than processors one of these is not left with all of them. */
const PARTS_PER_JOB = 8;

/** The C++ tests in parts, each with every n-th of them; `jobs` parts run at a time. */
async function cpp(folder, name, env) {
  const program = path.join(folder, "tetrafront_tests");
  const parts = Array.from({ length: PARTS_PER_JOB * jobs }, (_, part) => part);
  const counts = await inParallel(parts, async (part) => {
    const file = report(`${name}-${part}`);
    const sharding = { GTEST_TOTAL_SHARDS: `${parts.length}`, GTEST_SHARD_INDEX: `${part}` };
    await run(program, ["--gtest_brief=1", `--gtest_output=json:${file}`], {
      env: { ...env, ...sharding },
      quietOut: true,
    });
    return countGoogleTest(file);
  });
  return sum(counts);
}

/** Asks the system for a port nobody listens on. */
function freePort() {
  return new Promise((resolve, reject) => {
    const server = createServer();
    server.on("error", reject);
    server.listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/**
 * Every suite: what must be built before, and how it runs. `run` returns `{ passed, failed, failures }`;
 * `untested` tells, a line each, what could not be tested on this machine. The order puts quick answers first.
 */
export const suites = {
  format: {
    title: "format",
    needs: [],
    async run() {
      const script = check(await formatScript(false), "Prettier finds unformatted files: npm run format");
      return sum([
        script,
        check(await formatCpp(false), "clang-format finds unformatted files: npm run format"),
      ]);
    },
  },
  types: {
    title: "types",
    needs: ["wasm", "package"],
    async run() {
      const results = [];
      for (const project of ["wasm", "web", "tests"]) {
        const status = await run(bin("tsc"), ["-p", project, "--noEmit"], { quietOut: true });
        results.push(check(status === 0, `type errors in ${project}/`));
      }
      return sum(results);
    },
  },
  lint: {
    title: "lint (TypeScript, arrows, coroutines)",
    needs: ["wasm", "package"],
    async run() {
      const status = await run(bin("eslint"), [".", "--max-warnings", "0"], { quietOut: true });
      const wrong = wrongIncludes();
      const arrows = { ...check(wrong.length === 0, "C++ includes"), failures: wrong };
      const wrongTasks = wrongCoroutines();
      const coroutines = { ...check(wrongTasks.length === 0, "coroutines"), failures: wrongTasks };
      return sum([check(status === 0, "eslint finds problems"), arrows, coroutines]);
    },
  },
  unit: {
    title: "unit tests",
    // The native program too: its meshes and the package's are compared.
    needs: ["wasm", "package", "native"],
    async run() {
      const args = ["run", "--reporter=dot", "--reporter=json", `--outputFile.json=${report("unit")}`];
      await run(bin("vitest"), args, { quietOut: true });
      return countVitest(report("unit"));
    },
    untested: untestedOracles,
  },
  cpp: {
    title: "C++ tests (Release)",
    needs: ["native"],
    run: () => cpp(buildFolders.release, "cpp", {}),
  },
  tidy: {
    title: "lint (C++)",
    needs: ["database"],
    async run() {
      const bad = await tidy();
      return check(bad.length === 0, `clang-tidy finds problems in ${bad.join(", ")}`);
    },
  },
  "cpp-sanitized": {
    title: "C++ tests (ASan + UBSan)",
    needs: ["asan"],
    run: () => cpp(buildFolders.asan, "cpp-sanitized", { UBSAN_OPTIONS: "print_stacktrace=1" }),
  },
  fuzz: {
    title: "surfaces found by coverage",
    needs: ["fuzz"],
    async run() {
      if (findFuzzer() === undefined) return sum([]);
      const status = await fuzzSurfaces({ count: -1, seconds: FUZZ_SECONDS });
      return check(status === 0, "libFuzzer found a surface that the engine does not survive");
    },
    untested: () =>
      findFuzzer() === undefined
        ? [
            "NOT TESTED what libFuzzer finds (ruined surfaces from a seed were): install clang with its runtime",
          ]
        : [],
  },
  e2e: {
    title: "end-to-end tests",
    needs: ["wasm", "package", "site"],
    async run({ chromium }) {
      const env = {
        CHROMIUM: chromium,
        TETRAFRONT_E2E_PORT: `${await freePort()}`,
        PLAYWRIGHT_JSON_OUTPUT_NAME: report("e2e"),
      };
      await run(bin("playwright"), ["test", "--reporter=list,json"], { env, quietOut: true });
      return countPlaywright(report("e2e"));
    },
  },
};

/** Old reports must not be read as new ones. */
export function clearReports() {
  if (existsSync(reports)) rmSync(reports, { recursive: true });
  mkdirSync(reports, { recursive: true });
}

import { existsSync, mkdirSync, rmSync } from "node:fs";
import { createServer } from "node:net";
import path from "node:path";
import { formatCpp, formatScript } from "../format.mjs";
import { wrongCoroutines } from "./coroutines.mjs";
import {
  countGoogleTest,
  countPlaywright,
  countVitest,
  googleTestSeconds,
  longTests,
  sum,
} from "./counts.mjs";
import { fuzzSurfaces } from "./fuzzer.mjs";
import { untestedOracles } from "./oracles.mjs";
import { buildFolders, inRoot, reports } from "./paths.mjs";
import { inParallel, jobs, run } from "./run.mjs";
import { sourcesThatNeedOthers } from "./single-sources.mjs";
import { slowness } from "./slowness.mjs";
import { tidy } from "./tidy.mjs";
import { findFuzzer, typescriptCompiler } from "./tools.mjs";

const bin = (name) => inRoot("node_modules", ".bin", name);
const report = (name) => path.join(reports, `${name}.json`);

/** Seconds of fuzzing in a test run; `npm run fuzz` runs longer. */
const FUZZ_SECONDS = 60;

/** A static check counts as one test. */
const check = (ok, name) => ({ passed: ok ? 1 : 0, failed: ok ? 0 : 1, failures: ok ? [] : [name] });

/** Test durations differ widely: with many shards per processor, no processor is left with all long tests. */
const SHARDS_PER_JOB = 8;
const cppShards = Array.from({ length: SHARDS_PER_JOB * jobs }, (_, shard) => shard);
/** Time limit of a shard: one that takes longer hangs. tests/support/time_limit.cpp names the test that hangs. */
const SHARD_LIMIT_MS = 20 * 60_000;

/** After this time no suite begins or goes on, so that the table of results is printed before CI ends the run. */
const RUN_LIMIT_MS = 85 * 60_000;
const timeLeft = () => Math.max(1, Math.round(RUN_LIMIT_MS - performance.now()));

/** Sanitizers run the shortest C++ tests, which together take this part of the time of all: nine of ten tests. */
const SANITIZED_PART = 0.25;

/**
 * Returns a filter of GoogleTest that leaves out the tests that took longest in the release suite of this run. They are tests
 * of large meshes, in which sanitizers find nothing that smaller bodies do not show. Without reports, all tests run.
 */
function withoutLongTests() {
  const tests = googleTestSeconds(cppShards.map((shard) => report(`cpp-${shard}`)));
  return `-${longTests(tests, SANITIZED_PART).join(":")}`;
}

/** Runs the C++ tests in shards, `jobs` at a time. */
async function runGoogleTest(programName, name, env) {
  const program = path.join(buildFolders.release, programName);
  const counts = await inParallel(cppShards, async (shard) => {
    const file = report(`${name}-${shard}`);
    const sharding = { GTEST_TOTAL_SHARDS: `${cppShards.length}`, GTEST_SHARD_INDEX: `${shard}` };
    await run(program, ["--gtest_brief=1", `--gtest_output=json:${file}`], {
      env: { ...env, ...sharding },
      quietOut: true,
      timeout: Math.min(SHARD_LIMIT_MS, timeLeft()),
    });
    return countGoogleTest(file);
  });
  return sum(counts);
}

/** Asks the system for an unused port. */
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
 * All suites. `needs` lists the parts that must be built first. `run(tools, only)` returns
 * `{ passed, failed, failures }`; `tools.lanesInUse` lanes share the processors, and `only` restricts a suite to some
 * tests or files. `untested` lists, one line each, what this machine cannot test. A suite that `mayWait` is left out, and said
 * to be, when it would begin late: the machine is so slow that the other lane needs the rest of the time.
 */
export const suites = {
  format: {
    title: "format",
    needs: [],
    async run() {
      return sum([
        check(await formatScript(false), "oxfmt finds unformatted files: npm run format"),
        check(await formatCpp(false), "clang-format finds unformatted files: npm run format"),
      ]);
    },
  },
  cpp: {
    title: "C++ tests (release)",
    needs: ["database", "native"],
    run: () => runGoogleTest("tetrafront_tests", "cpp", {}),
  },
  types: {
    title: "types",
    needs: ["wasm", "package"],
    async run() {
      const results = [];
      for (const project of ["wasm", "web", "tests"]) {
        const args = ["-p", project, "--noEmit"];
        const status = await run(typescriptCompiler, args, { quietOut: true });
        results.push(check(status === 0, `type errors in ${project}/`));
      }
      return sum(results);
    },
  },
  lint: {
    title: "lint (TypeScript, dependencies)",
    needs: ["wasm", "package"],
    async run(_tools, only = ["."]) {
      const config = ["--config", inRoot("oxlint.config.mjs"), "--no-error-on-unmatched-pattern"];
      const status = await run(bin("oxlint"), [...config, ...only], { quietOut: true });
      // Finds exports and files that nobody uses; of the whole workspace, or not at all.
      const unused = only[0] === "." ? await run(bin("knip"), ["--no-progress"], { quietOut: true }) : 0;
      // Reads TypeScript with a package that the setup installs.
      const { engineLayers, layeredFolders, wrongImports, wrongIncludes } =
        await import("./dependencies.mjs");
      const found = {
        "C++ includes": wrongIncludes(engineLayers),
        "C++ coroutines": wrongCoroutines(),
        ...Object.fromEntries(
          Object.entries(layeredFolders).map(([name, layers]) => [name, wrongImports(layers)]),
        ),
      };
      const rules = Object.entries(found).map(([name, failures]) => ({
        ...check(failures.length === 0, name),
        failures,
      }));
      return sum([
        check(status === 0, "oxlint finds problems"),
        check(unused === 0, "knip finds exports or files that nobody uses"),
        ...rules,
      ]);
    },
  },
  tidy: {
    title: "lint (C++)",
    needs: ["database"],
    async run() {
      const bad = await tidy();
      return check(bad.length === 0, `clang-tidy finds problems in ${bad.join(", ")}`);
    },
  },
  alone: {
    title: "C++ sources, each alone",
    mayWait: true,
    needs: [],
    async run({ compiler }) {
      const bad = await sourcesThatNeedOthers(compiler);
      return check(bad.length === 0, `cannot be compiled alone: ${bad.join(", ")}`);
    },
  },
  "cpp-asan": {
    title: "C++ tests (ASan + UBSan)",
    mayWait: true,
    needs: ["database", "asan"],
    run: () =>
      runGoogleTest("tetrafront_tests_sanitized", "cpp-asan", {
        UBSAN_OPTIONS: "print_stacktrace=1",
        GTEST_FILTER: withoutLongTests(),
      }),
  },
  fuzz: {
    title: "libFuzzer",
    needs: ["fuzz"],
    async run() {
      if (findFuzzer() === undefined) return sum([]);
      const status = await fuzzSurfaces({ count: -1, seconds: FUZZ_SECONDS });
      return check(status === 0, "libFuzzer found a surface that crashes the engine");
    },
    untested: () =>
      findFuzzer() === undefined
        ? [
            "NOT TESTED what libFuzzer finds: install clang with its fuzzer runtime (seeded surfaces were tested)",
          ]
        : [],
  },
  e2e: {
    title: "end-to-end tests",
    needs: ["wasm", "package", "site"],
    async run({ chromium, lanesInUse }, only = []) {
      const env = {
        CHROMIUM: chromium,
        TETRAFRONT_SLOWNESS: `${lanesInUse * slowness()}`,
        TETRAFRONT_E2E_PORT: `${await freePort()}`,
        PLAYWRIGHT_JSON_OUTPUT_NAME: report("e2e"),
      };
      const options = { env, quietOut: true, timeout: timeLeft() };
      await run(bin("playwright"), ["test", ...only, "--reporter=list,json"], options);
      return countPlaywright(report("e2e"));
    },
  },
  unit: {
    title: "unit tests",
    // One test compares the meshes of the package with those of the native program.
    needs: ["wasm", "package", "database", "native", "oracles"],
    async run(_tools, only = []) {
      const output = `--outputFile.json=${report("unit")}`;
      await run(bin("vitest"), ["run", ...only, "--reporter=default", "--reporter=json", output], {
        quietOut: true,
        timeout: timeLeft(),
      });
      return countVitest(report("unit"));
    },
    untested: untestedOracles,
  },
};

/**
 * The suites of a lane run one after the other, the lanes side by side. Either lane alone can keep two processors busy,
 * so none is idle when the other lane ends, while its programs start or link, or while a test waits for the browser.
 * Both take about the same processor time. What needs the package comes late in the lane that does not build it, and what may
 * wait comes last.
 */
export const lanes = [
  ["format", "cpp", "types", "lint", "tidy", "alone", "unit", "cpp-asan", "fuzz"],
  ["e2e"],
];

/** Removes the reports of earlier runs. */
export function clearReports() {
  if (existsSync(reports)) rmSync(reports, { recursive: true });
  mkdirSync(reports, { recursive: true });
}

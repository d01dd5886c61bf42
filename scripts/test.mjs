// npm test [-- SUITE...]: sets up, builds and runs the named suites (default: all), then prints a table.
// npm test -- changed: runs only the tests that the changes of this branch can break.
// The last line of standard output is "N passed, N failed" over all suites.
import { build } from "./build.mjs";
import { changedFiles, suitesFor } from "./lib/changed.mjs";
import { sum } from "./lib/counts.mjs";
import { main, say, UserError } from "./lib/run.mjs";
import { clearReports, lanes, suites } from "./lib/suites.mjs";
import { setup } from "./setup.mjs";

/**
 * Returns a function that builds parts, each once although both lanes request it. Its promise resolves to the
 * reason of a failure, or undefined.
 */
function builder(tools) {
  const builds = new Map();
  const buildOnce = (part) => {
    if (!builds.has(part))
      builds.set(
        part,
        failureOf(() => build([part], tools)),
      );
    return builds.get(part);
  };
  return async (parts) => {
    for (const part of parts) {
      const failure = await buildOnce(part);
      if (failure !== undefined) return `cannot build ${part}: ${failure}`;
    }
    return undefined;
  };
}

async function failureOf(work) {
  try {
    await work();
    return undefined;
  } catch (error) {
    return error instanceof UserError ? error.message : (error.stack ?? String(error));
  }
}

/** After this time, suites that may wait do not begin. */
const LATE_S = 40 * 60;

async function runSuite(suite, only, tools, prepare) {
  const from = seconds();
  if (suite.mayWait && from > LATE_S) return { suite, from, to: from, counts: sum([]), isLeftOut: true };
  let counts;
  const failure =
    (await prepare(suite.needs)) ??
    (await failureOf(async () => {
      counts = await suite.run(tools, only);
    }));
  return { suite, from, to: seconds(), counts: counts ?? { passed: 0, failed: 1, failures: [failure] } };
}

/** Runs the selected suites of one lane, one after the other. */
async function runLane(lane, selection, tools, prepare) {
  const rows = [];
  for (const name of lane.filter((name) => selection.has(name))) {
    const row = await runSuite(suites[name], selection.get(name), tools, prepare);
    say(`\n== ${suites[name].title}: ${row.counts.passed} passed, ${row.counts.failed} failed`);
    rows.push(row);
  }
  return rows;
}

/** Seconds since this program started. */
const seconds = () => performance.now() / 1000;

function print(rows, all) {
  const lines = rows.map(({ suite, counts, from, to }) => {
    const numbers = `${String(counts.passed).padStart(6)} passed ${String(counts.failed).padStart(4)} failed`;
    const time = `${(to - from).toFixed(1).padStart(8)} s`;
    return `${suite.title.padEnd(32)}${numbers} ${time}  from ${from.toFixed(0).padStart(4)} s`;
  });
  const listed = (word, names) =>
    rows.flatMap(({ suite, counts }) => names(counts).map((name) => `${word} ${suite.title}: ${name}`));
  const unstable = listed("FAILED ONCE, then passed,", (counts) => counts.unstable ?? []);
  const failures = listed("FAILED", (counts) => counts.failures);
  const untested = rows.flatMap(({ suite, isLeftOut }) =>
    isLeftOut
      ? [`NOT TESTED ${suite.title}: this machine is slow or busy; name the suite to run it alone`]
      : (suite.untested?.() ?? []),
  );
  const total = `${"all, with builds and setup".padEnd(57)}${seconds().toFixed(1).padStart(8)} s`;
  process.stdout.write(
    `\n${[...lines, total, ...untested, ...unstable, ...failures, `${all.passed} passed, ${all.failed} failed`].join("\n")}\n`,
  );
}

/** Returns the suites to run, each with the tests to run in it (`undefined`: all). */
function select(names) {
  if (names.length === 0) return new Map(Object.keys(suites).map((name) => [name, undefined]));
  if (names.length === 1 && names[0] === "changed") {
    const files = changedFiles();
    const selection = suitesFor(files);
    say(`${files.length} changed files: ${[...selection.keys()].join(", ") || "nothing to test"}`);
    return selection;
  }
  const unknown = names.find((name) => !Object.hasOwn(suites, name));
  if (unknown !== undefined) {
    const known = ["changed", ...Object.keys(suites)].join(", ");
    throw new UserError(`There is no suite "${unknown}"; the suites are ${known}`);
  }
  return new Map(names.map((name) => [name, undefined]));
}

await main(async () => {
  const selection = select(process.argv.slice(2));
  const tools = await setup(["native", "tests"]);
  clearReports();
  const prepare = builder(tools);
  // A download, beside everything else.
  if (selection.has("unit")) void prepare(["oracles"]);
  const used = lanes.filter((lane) => lane.some((name) => selection.has(name)));
  const sharing = { ...tools, lanesInUse: used.length };
  const running = used.map((lane) => runLane(lane, selection, sharing, prepare));
  const rows = (await Promise.all(running)).flat();
  const all = sum(rows.map((row) => row.counts));
  print(rows, all);
  if (all.failed > 0) process.exitCode = 1;
});

// npm test: sets up, builds and runs the suites named on the command line (default: all), whatever fails.
// The last line of standard output is "N passed, N failed" over all of them.
import { build } from "./build.mjs";
import { sum } from "./lib/counts.mjs";
import { main, say, UserError } from "./lib/run.mjs";
import { clearReports, suites } from "./lib/suites.mjs";
import { setup } from "./setup.mjs";

/** Builds what a suite needs, each part once; returns why it could not be built, or undefined. */
function builder(tools) {
  const outcomes = new Map();
  return async (parts) => {
    for (const part of parts) {
      if (!outcomes.has(part)) outcomes.set(part, await attempt(() => build([part], tools)));
      const problem = outcomes.get(part);
      if (problem !== undefined) return `cannot build ${part}: ${problem}`;
    }
    return undefined;
  };
}

async function attempt(body) {
  try {
    await body();
    return undefined;
  } catch (error) {
    return error instanceof UserError ? error.message : (error.stack ?? String(error));
  }
}

async function runSuite(suite, tools, prepare) {
  const problem = await prepare(suite.needs);
  if (problem !== undefined) return { passed: 0, failed: 1, failures: [problem] };
  let counts;
  const crash = await attempt(async () => {
    counts = await suite.run(tools);
  });
  return counts ?? { passed: 0, failed: 1, failures: [crash] };
}

function print(rows, all, seconds) {
  const lines = rows.map(({ suite, counts, seconds: s }) => {
    const numbers = `${String(counts.passed).padStart(6)} passed ${String(counts.failed).padStart(4)} failed`;
    return `${suite.title.padEnd(26)}${numbers} ${s.toFixed(1).padStart(8)} s`;
  });
  const failures = rows.flatMap(({ suite, counts }) =>
    counts.failures.map((name) => `FAILED ${suite.title}: ${name}`),
  );
  const untested = rows.flatMap(({ suite }) => suite.untested?.() ?? []);
  const total = `${"all, with setup".padEnd(51)}${seconds.toFixed(1).padStart(8)} s`;
  process.stdout.write(
    `\n${[...lines, total, ...untested, ...failures, `${all.passed} passed, ${all.failed} failed`].join("\n")}\n`,
  );
}

await main(async () => {
  const started = performance.now();
  const secondsSince = (time) => (performance.now() - time) / 1000;
  const tools = await setup(["native", "tests"]);
  const names = process.argv.slice(2);
  const unknown = names.find((name) => !Object.hasOwn(suites, name));
  if (unknown)
    throw new UserError(`There is no suite "${unknown}"; the suites are ${Object.keys(suites).join(", ")}`);

  clearReports();
  const prepare = builder(tools);
  const rows = [];
  for (const name of names.length > 0 ? names : Object.keys(suites)) {
    say(`\n== ${suites[name].title}`);
    const begun = performance.now();
    const counts = await runSuite(suites[name], tools, prepare);
    rows.push({ suite: suites[name], counts, seconds: secondsSince(begun) });
  }
  const all = sum(rows.map((row) => row.counts));
  print(rows, all, secondsSince(started));
  if (all.failed > 0) process.exitCode = 1;
});

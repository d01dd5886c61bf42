// npm run fuzz [COUNT]: ruined surfaces, and ruined files of every format, as many as one likes (default 20 000 each):
// seeded ones through the package and, where clang has libFuzzer, surfaces that it finds by their coverage of the engine.
import { mkdirSync } from "node:fs";
import path from "node:path";
import { steps } from "./build.mjs";
import { buildFolders, inRoot } from "./lib/paths.mjs";
import { main, must, say, UserError } from "./lib/run.mjs";
import { findFuzzer } from "./lib/tools.mjs";

/** Under sanitizers some tens of surfaces a second are filled; so long and no longer. */
const MOST_SECONDS = 600;

await main(async () => {
  const count = process.argv[2] ?? "20000";
  if (!/^[1-9]\d*$/.test(count)) throw new UserError(`"${count}" is no number of surfaces`);
  const tests = ["surface", "reader"].map((name) => `tests/unit/package/${name}-fuzz.test.ts`);
  const seeded = ["run", ...tests, "--testTimeout=0"];
  await must(inRoot("node_modules", ".bin", "vitest"), seeded, { env: { TETRAFRONT_FUZZ: count } });

  const compiler = findFuzzer();
  if (compiler === undefined) {
    say("fuzz: no clang with libFuzzer was found, so that was all");
    return;
  }
  await steps.fuzzer({ compiler });
  // What has reached new code is kept from one run to the next.
  const corpus = path.join(buildFolders.fuzz, "corpus");
  mkdirSync(corpus, { recursive: true });
  const program = path.join(buildFolders.fuzz, "fuzz_fill_surface");
  const limits = [`-runs=${count}`, `-max_total_time=${MOST_SECONDS}`];
  const each = ["-max_len=200", "-len_control=0", "-timeout=60", "-rss_limit_mb=2000"];
  await must(program, [...limits, ...each, "-print_final_stats=1", corpus], {
    cwd: buildFolders.fuzz,
    quietOut: true,
  });
});

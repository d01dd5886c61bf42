import { mkdirSync } from "node:fs";
import path from "node:path";
import { buildFolders } from "./paths.mjs";
import { run } from "./run.mjs";

/**
 * Runs libFuzzer on surfaces; keeps those that reach new code from one run to the next. Ends after `count`
 * surfaces or `seconds`, whichever comes first, or at the first surface that crashes the engine. Returns the exit
 * status. The program must be built.
 */
export async function fuzzSurfaces({ count, seconds }) {
  const corpus = path.join(buildFolders.fuzz, "corpus");
  mkdirSync(corpus, { recursive: true });
  const limits = [`-runs=${count}`, `-max_total_time=${seconds}`];
  const each = ["-max_len=200", "-len_control=0", "-timeout=60", "-rss_limit_mb=2000"];
  const program = path.join(buildFolders.fuzz, "fuzz_fill_surface");
  return run(program, [...limits, ...each, "-seed=1", "-print_final_stats=1", corpus], {
    cwd: buildFolders.fuzz,
    quietOut: true,
  });
}

import { mkdirSync } from "node:fs";
import path from "node:path";
import { buildFolders } from "./paths.mjs";
import { run } from "./run.mjs";

/**
 * Lets libFuzzer look for surfaces that reach new code; what has is kept from one run to the next. Ends after so many
 * surfaces or seconds, whichever comes first, or with the first that the engine does not survive. Returns the exit
 * status; the program must be built.
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

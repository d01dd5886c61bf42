// npm run fuzz [COUNT]: ruined surfaces, as many as one likes (default 20 000): seeded ones through the package and,
// where clang has libFuzzer, as many again that it finds by their coverage of the engine.
import { mkdirSync } from "node:fs";
import path from "node:path";
import { steps } from "./build.mjs";
import { buildFolders, inRoot } from "./lib/paths.mjs";
import { main, must, say, UserError } from "./lib/run.mjs";
import { findFuzzer } from "./lib/tools.mjs";

await main(async () => {
  const count = process.argv[2] ?? "20000";
  if (!/^[1-9]\d*$/.test(count)) throw new UserError(`"${count}" is no number of surfaces`);
  const seeded = ["run", "tests/unit/package/surface-fuzz.test.ts", "--testTimeout=0"];
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
  const limits = [`-runs=${count}`, "-max_len=200", "-len_control=0", "-timeout=60", "-rss_limit_mb=2000"];
  await must(program, [...limits, "-print_final_stats=1", corpus], {
    cwd: buildFolders.fuzz,
    quietOut: true,
  });
});

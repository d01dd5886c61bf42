// npm run fuzz [COUNT]: ruined surfaces, and ruined files of every format, as many as one likes (default 20 000 each):
// seeded ones through the package and, where clang has libFuzzer, surfaces that it finds by their coverage of the engine.
import { build } from "./build.mjs";
import { fuzzSurfaces } from "./lib/fuzzer.mjs";
import { inRoot } from "./lib/paths.mjs";
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

  if (findFuzzer() === undefined) {
    say("fuzz: no clang with libFuzzer was found, so that was all");
    return;
  }
  await build(["fuzz"], {});
  if ((await fuzzSurfaces({ count, seconds: MOST_SECONDS })) !== 0)
    throw new UserError("A surface was found that the engine does not survive; see above");
});

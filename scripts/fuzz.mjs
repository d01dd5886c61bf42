// npm run fuzz [COUNT]: meshes COUNT (default 20 000) damaged surfaces and reads as many damaged projects and files of
// every format, CAD files among them, all through the package and generated from seeds. If clang has libFuzzer, it also searches
// for surfaces guided by the coverage of the engine.
import { build } from "./build.mjs";
import { fuzzSurfaces } from "./lib/fuzzer.mjs";
import { inRoot } from "./lib/paths.mjs";
import { main, must, say, UserError } from "./lib/run.mjs";
import { findFuzzer } from "./lib/tools.mjs";

/** Time limit: under sanitizers the engine meshes some tens of surfaces per second. */
const MOST_SECONDS = 600;

await main(async () => {
  const count = process.argv[2] ?? "20000";
  if (!/^[1-9]\d*$/.test(count)) throw new UserError(`"${count}" is no number of surfaces`);
  const tests = ["surface-fuzz", "reader-fuzz", "project-fuzz", "cad-files"].map(
    (name) => `tests/unit/package/${name}.test.ts`,
  );
  const seeded = ["run", ...tests, "--testTimeout=0"];
  await must(inRoot("node_modules", ".bin", "vitest"), seeded, { env: { TETRAFRONT_FUZZ: count } });

  if (findFuzzer() === undefined) {
    say("fuzz: no clang with libFuzzer was found, so the search guided by coverage is left out");
    return;
  }
  await build(["fuzz"], {});
  if ((await fuzzSurfaces({ count, seconds: MOST_SECONDS })) !== 0)
    throw new UserError("Found a surface that crashes the engine; see above");
});

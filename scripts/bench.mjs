// npm run bench [NAME...]: builds the engine natively and to WebAssembly and runs tests/bench/NAME.mjs (default:
// all) one after the other. TETRAFRONT_FILL gives a benchmark the path of the native program.
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { build } from "./build.mjs";
import { buildFolders, inRoot } from "./lib/paths.mjs";
import { main, must, say, UserError } from "./lib/run.mjs";
import { setup } from "./setup.mjs";

const folder = inRoot("tests", "bench");

/** Modules that export something are helpers of benchmarks. */
function isBenchmark(name) {
  return name.endsWith(".mjs") && !/^export /m.test(readFileSync(path.join(folder, name), "utf8"));
}

await main(async () => {
  const all = readdirSync(folder).filter(isBenchmark).sort();
  const names = process.argv.slice(2).map((name) => `${path.basename(name, ".mjs")}.mjs`);
  const unknown = names.find((name) => !all.includes(name));
  if (unknown) throw new UserError(`There is no tests/bench/${unknown}; there are ${all.join(", ")}`);
  await build(["wasm", "package", "site", "native"], await setup(["native", "tests", "oracles"]));
  const env = { TETRAFRONT_FILL: path.join(buildFolders.release, "fill") };
  for (const name of names.length > 0 ? names : all) {
    say(`\n== ${name}`);
    await must(process.execPath, [path.join(folder, name)], { env });
  }
});

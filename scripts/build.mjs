// Builds the parts named on the command line: wasm (the engine), package (the npm package's JavaScript),
// site (the web application), native (library, programs, tests), asan (the tests with
// sanitizers), fuzz. Default: wasm package site.
import { existsSync, rmSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { filesUnder, hashOf, isFresh, markFresh } from "./lib/fresh.mjs";
import {
  bundleCommandLine,
  bundlePages,
  dropOrphans,
  minifyScripts,
  MODULES,
  writeProjectSchema,
} from "./lib/package-files.mjs";
import { buildFolders, inRoot } from "./lib/paths.mjs";
import { jobs, main, must, say, UserError } from "./lib/run.mjs";
import { findFuzzer, typescriptCompiler, which } from "./lib/tools.mjs";
import { ensurePython } from "./lib/python.mjs";
import { setup } from "./setup.mjs";

const bin = (name) => inRoot("node_modules", ".bin", name);

/** Each step takes what `setup` returned and does nothing if its inputs have not changed. */
export const steps = {
  async wasm({ emscripten }) {
    await compile("wasm", { ...emscripten.env, EMSCRIPTEN_ROOT: emscripten.folder });
    await minifyScripts();
  },
  async package() {
    const inputs = filesUnder(
      [
        inRoot("wasm"),
        inRoot("tsconfig.base.json"),
        inRoot("package-lock.json"),
        inRoot("scripts", "lib", "notices.mjs"),
        inRoot("scripts", "notices"),
      ],
      { skip: ["node_modules", "dist", "THIRD-PARTY-NOTICES.txt"] },
    );
    const types = MODULES.map((module) => inRoot("wasm", "dist", "engine", `${module}.d.ts`));
    const hash = hashOf([...inputs, ...types]);
    const stamp = inRoot("wasm", "dist", ".built-from");
    if (isFresh(stamp, hash)) return;
    await must(typescriptCompiler, ["-p", "wasm"], { quietOut: true });
    dropOrphans();
    await writeProjectSchema();
    await bundlePages();
    await bundleCommandLine();
    markFresh(stamp, hash);
  },
  async site() {
    const inputs = filesUnder([
      inRoot("web"),
      inRoot("public"),
      inRoot("package-lock.json"),
      inRoot("tsconfig.base.json"),
      inRoot("scripts", "lib"),
      inRoot("scripts", "notices"),
    ]);
    const hash = hashOf([...inputs, ...filesUnder([inRoot("wasm", "dist")], { skip: [] })]);
    const stamp = inRoot("build", "site.stamp");
    if (isFresh(stamp, hash) && existsSync(inRoot("web", "dist", "index.html"))) return;
    await must(bin("vite"), ["build", "web", "--logLevel", "warn"], { quietOut: true });
    markFresh(stamp, hash);
  },
  async native({ compiler }) {
    await compile("release", { CXX: compiler });
  },
  /**
   * Configures only: clang-tidy reads compile_commands.json and the sources of the unity build. Suites that need
   * `native` or `asan` need this first, because two of them must not configure at the same time.
   */
  async database({ compiler }) {
    await configure("release", { CXX: compiler });
    const log = path.join(buildFolders.release, "configure-again.log");
    await must("ninja", ["-C", buildFolders.release, "build.ninja"], { log });
  },
  async asan({ compiler }) {
    await compile("asan", { CXX: compiler }, "release");
  },
  /** Installs the Python packages that check our files: a download, which the other builds need not wait for. */
  oracles: ensurePython,
  /** Does nothing if no clang with libFuzzer is installed. */
  async fuzz() {
    const compiler = findFuzzer();
    if (compiler !== undefined) await compile("fuzz", { CXX: compiler });
  },
};

/** Builds a build preset of CMakePresets.json, after configuring its configure preset where needed. */
async function compile(preset, env, configurePreset = preset) {
  await configure(configurePreset, env);
  await must("cmake", ["--build", "--preset", preset, "--parallel", `${jobs}`], { env, quietOut: true });
}

/** Configures a preset once; ninja itself runs CMake again when a CMakeLists.txt changes. */
async function configure(preset, env) {
  const folder = buildFolders[preset];
  const stamp = path.join(folder, "configured-with");
  const inputs = `${hashOf([inRoot("CMakePresets.json")])} ${JSON.stringify(env)}`;
  if (existsSync(path.join(folder, "build.ninja")) && isFresh(stamp, inputs)) return;
  rmSync(path.join(folder, "CMakeCache.txt"), { force: true });
  const log = path.join(folder, "configure.log");
  await must(which("cmake") ?? "cmake", ["--preset", preset], { env, log });
  markFresh(stamp, inputs);
}

export async function build(names, tools) {
  for (const name of names) {
    if (!Object.hasOwn(steps, name)) {
      throw new UserError(
        `There is no part "${name}" to build; the parts are ${Object.keys(steps).join(", ")}`,
      );
    }
    const started = performance.now();
    await steps[name](tools);
    say(`build: ${name} (${((performance.now() - started) / 1000).toFixed(1)} s)`);
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await main(async () => {
    const names = process.argv.slice(2);
    const parts = names.length > 0 ? names : ["wasm", "package", "site"];
    const needsCompiler = parts.some((name) => ["native", "database", "asan"].includes(name));
    await build(parts, await setup(needsCompiler ? ["native", "tests"] : []));
  });
}

// Builds the parts named on the command line: wasm (the engine), package (the npm package's JavaScript),
// site (the web application), native (library, fill, tests). Default: wasm package site.
import { existsSync, rmSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { emscriptenToolchainFile } from "./lib/emscripten.mjs";
import { filesUnder, hashOf, isFresh, markFresh } from "./lib/fresh.mjs";
import {
  bundleCommandLine,
  bundlePages,
  dropOrphans,
  minifyLoader,
  writeProjectSchema,
} from "./lib/package-files.mjs";
import { buildFolders, glmFolder, inRoot } from "./lib/paths.mjs";
import { jobs, main, must, say, UserError } from "./lib/run.mjs";
import { findFuzzer, which } from "./lib/tools.mjs";
import { setup } from "./setup.mjs";

const bin = (name) => inRoot("node_modules", ".bin", name);

/** @param tools what `setup` returned; every step is free when nothing changed. */
export const steps = {
  async wasm({ emscripten }) {
    const file = emscriptenToolchainFile(emscripten.folder);
    await configure(buildFolders.wasm, inRoot("wasm"), [`-DCMAKE_TOOLCHAIN_FILE=${file}`], emscripten.env);
    await must("ninja", [`-j${jobs}`, "-C", buildFolders.wasm, "engine"], {
      env: emscripten.env,
      quietOut: true,
    });
    await minifyLoader();
  },
  async package() {
    const inputs = filesUnder([inRoot("wasm"), inRoot("tsconfig.base.json"), inRoot("package-lock.json")]);
    const hash = hashOf([...inputs, inRoot("wasm", "dist", "engine", "engine.d.ts")]);
    const stamp = inRoot("wasm", "dist", ".built-from");
    if (isFresh(stamp, hash)) return;
    await must(bin("tsc"), ["-p", "wasm"], { quietOut: true });
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
    ]);
    const hash = hashOf([...inputs, ...filesUnder([inRoot("wasm", "dist")], { skip: [] })]);
    const stamp = inRoot("build", "site.stamp");
    if (isFresh(stamp, hash) && existsSync(inRoot("web", "dist", "index.html"))) return;
    await must(bin("vite"), ["build", "web", "--logLevel", "warn"], { quietOut: true });
    markFresh(stamp, hash);
  },
  async native(tools) {
    await steps.database(tools);
    await must("ninja", [`-j${jobs}`, "-C", buildFolders.native], { quietOut: true });
  },
  /** Only configures: clang-tidy reads compile_commands.json and needs nothing compiled. */
  async database({ compiler }) {
    await configureNative(buildFolders.native, compiler, ["-DCMAKE_BUILD_TYPE=Release"]);
    const log = path.join(buildFolders.native, "configure-again.log");
    await must("ninja", ["-C", buildFolders.native, "build.ninja"], { log });
  },
  async sanitized({ compiler }) {
    await configureNative(buildFolders.asan, compiler, [
      "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
      // Without NDEBUG: our own assertions and the library's are part of this build.
      "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -D_GLIBCXX_ASSERTIONS",
      "-DTETRAFRONT_APPS=OFF",
      "-DTETRAFRONT_PCH=ON",
      "-DTETRAFRONT_SANITIZE=address,undefined",
    ]);
    await must("ninja", [`-j${jobs}`, "-C", buildFolders.asan], { quietOut: true });
  },
  /** The targets of libFuzzer, where there is a clang that has it. */
  async fuzzer() {
    const compiler = findFuzzer();
    if (compiler === undefined) return;
    await configureNative(buildFolders.fuzz, compiler, [
      "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
      "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -gline-tables-only",
      "-DTETRAFRONT_APPS=OFF",
      "-DTETRAFRONT_TESTS=OFF",
      "-DTETRAFRONT_FUZZ=ON",
      // Clang warns of what is in the headers of older libstdc++.
      "-DTETRAFRONT_WERROR=OFF",
      "-DTETRAFRONT_SANITIZE=address,undefined",
    ]);
    await must("ninja", [`-j${jobs}`, "-C", buildFolders.fuzz], { quietOut: true });
  },
};

function configureNative(folder, compiler, options) {
  return configure(folder, inRoot("cpp"), [`-DCMAKE_CXX_COMPILER=${compiler}`, ...options], {});
}

/** Configures once; ninja itself runs CMake again when a CMakeLists.txt changes. */
async function configure(folder, source, options, env) {
  const args = [
    "-G",
    "Ninja",
    "-S",
    source,
    "-B",
    folder,
    `-DTETRAFRONT_GLM_INCLUDE=${glmFolder}`,
    ...options,
  ];
  const stamp = path.join(folder, "configured-with");
  const wanted = JSON.stringify(args);
  if (existsSync(path.join(folder, "build.ninja")) && isFresh(stamp, wanted)) return;
  rmSync(path.join(folder, "CMakeCache.txt"), { force: true });
  await must(which("cmake") ?? "cmake", args, { env, log: path.join(folder, "configure.log") });
  markFresh(stamp, wanted);
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
    const wanted = names.length > 0 ? names : ["wasm", "package", "site"];
    const isNative = wanted.some((name) => name === "native" || name === "sanitized");
    await build(wanted, await setup(isNative ? ["native", "tests"] : []));
  });
}

// npm run setup: installs what a fresh clone needs: npm packages, Emscripten, GLM and, for the tests, a native
// compiler, GoogleTest, clang-tidy, Chromium and, if available, Python packages. Requires only Node. Takes no time
// if everything is installed.
import { lstatSync, mkdirSync, readlinkSync, rmSync, symlinkSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { installMissing } from "./lib/apt.mjs";
import { ensureEmscripten, glmBesideEmscripten } from "./lib/emscripten.mjs";
import { ensurePackages } from "./lib/npm.mjs";
import { ensurePython } from "./lib/python.mjs";
import { glmFolder } from "./lib/paths.mjs";
import { main, say, UserError } from "./lib/run.mjs";
import { findChromium, findCompiler, findGoogleTest, findSystemGlm, findTidy, which } from "./lib/tools.mjs";

const kMinNode = 20;

/** What every build needs, and what each purpose adds. `find` runs again after an installation. */
const needs = {
  build: [
    { what: "CMake", debian: "cmake", find: () => which("cmake") },
    { what: "Ninja", debian: "ninja-build", find: () => which("ninja") },
    { what: "Python 3 (for Emscripten)", debian: "python3", find: () => which("python3") },
  ],
  native: [{ what: "a C++20 compiler (g++ 11, clang 14 or later)", debian: "g++", find: findCompiler }],
  tests: [
    { what: "GoogleTest", debian: "libgtest-dev", find: findGoogleTest },
    { what: "clang-tidy (16 or later)", debian: "clang-tidy-19", find: findTidy },
    { what: "Chromium", debian: "chromium-headless-shell", find: findChromium },
  ],
};

/**
 * @param purposes what to install in addition to what a build needs: "native" (to compile for this machine), "tests",
 * "oracles" (Python packages that check our files).
 * @returns the tools found: `{ emscripten, compiler, chromium }`.
 */
export async function setup(purposes = ["native", "tests", "oracles"]) {
  if (Number(process.versions.node.split(".")[0]) < kMinNode) {
    throw new UserError(`Node ${kMinNode} or later is needed; this is ${process.version}`);
  }
  if (process.env.CHROMIUM && purposes.includes("tests") && !findChromium()) {
    throw new UserError(`CHROMIUM=${process.env.CHROMIUM} is not a program: correct or unset it`);
  }
  const wanted = ["build", ...purposes].flatMap((purpose) => needs[purpose] ?? []);
  await installMissing(wanted.filter((item) => item.find() === undefined));
  const stillMissing = wanted.filter((item) => item.find() === undefined);
  if (stillMissing.length > 0) {
    const words = stillMissing.map((item) => item.what).join(", ");
    throw new UserError(`Still not found after installing Debian's packages: ${words}`);
  }
  // Python's system packages come last: only one program at a time can use apt.
  const [emscripten] = await Promise.all([ensureEmscripten(), ensurePackages()]);
  if (purposes.includes("oracles")) await ensurePython();
  await ensureGlm(emscripten.folder);
  return { emscripten, compiler: findCompiler(), chromium: findChromium() };
}

/**
 * Links one folder that contains only GLM, for both compilers: the system's whole include folder would mix the
 * native C library into the WebAssembly build.
 */
async function ensureGlm(emscriptenFolder) {
  const find = () => glmBesideEmscripten(emscriptenFolder) ?? findSystemGlm();
  if (find() === undefined) await installMissing([{ what: "GLM", debian: "libglm-dev" }]);
  const include = find();
  if (include === undefined)
    throw new UserError("GLM's headers are still not found: set GLM_INCLUDE to their folder");
  const target = path.join(include, "glm");
  const link = path.join(glmFolder, "glm");
  if (lstatSync(link, { throwIfNoEntry: false }) && readlinkSync(link) === target) return;
  rmSync(glmFolder, { recursive: true, force: true });
  mkdirSync(glmFolder, { recursive: true });
  symlinkSync(target, link, "junction");
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await main(async () => {
    const started = performance.now();
    await setup();
    say(`setup: everything is installed (${((performance.now() - started) / 1000).toFixed(1)} s)`);
  });
}

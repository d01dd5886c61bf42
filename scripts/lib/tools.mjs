import { accessSync, constants, existsSync, readdirSync, statSync } from "node:fs";
import { homedir } from "node:os";
import path from "node:path";
import { inRoot } from "./paths.mjs";
import { output } from "./run.mjs";

/** Returns the full path of a program on PATH, or undefined. */
export function which(...names) {
  for (const name of names) {
    for (const folder of (process.env.PATH ?? "").split(path.delimiter)) {
      const file = path.join(folder, process.platform === "win32" ? `${name}.exe` : name);
      if (isExecutable(file)) return file;
    }
  }
  return undefined;
}

function isExecutable(file) {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}

/** Returns the first version like "1.2.3" in a text as numbers, or undefined. */
export function versionIn(text) {
  const match = /(\d+)\.(\d+)(?:\.(\d+))?/.exec(text ?? "");
  return match ? [Number(match[1]), Number(match[2]), Number(match[3] ?? 0)] : undefined;
}

/** Returns whether `version` is at least `least`; both are [major, minor, patch]. */
export function atLeast(version, least) {
  for (let i = 0; i < least.length; i += 1) {
    if (version[i] !== least[i]) return version[i] > least[i];
  }
  return true;
}

/**
 * The compiler of TypeScript 7, a native program that takes a quarter of the time. TypeDoc, API Extractor and
 * scripts/lib/dependencies.mjs need the JavaScript API of TypeScript 6, which it lacks.
 */
export const typescriptCompiler = inRoot("node_modules", "@typescript", "native", "bin", "tsc");

/** Returns a native compiler that can build the engine (C++20 with <span>, <bit>, <numbers>), or undefined. */
export function findCompiler() {
  const wanted = process.env.CXX ? [process.env.CXX] : ["g++", "clang++", "c++"];
  for (const name of wanted) {
    const program = path.isAbsolute(name) ? name : which(name);
    if (program === undefined) continue;
    const version = versionIn(output(program, ["-dumpfullversion", "-dumpversion"]));
    const isClang = /clang/.test(path.basename(program)) || process.platform === "darwin";
    if (version && atLeast(version, isClang ? [14, 0, 0] : [11, 0, 0])) return program;
  }
  return undefined;
}

/**
 * Returns clang-tidy 19, or another one from version 16 on, which supports C++20's ranges. Warnings differ between
 * versions.
 */
export function findTidy() {
  const exact = which("clang-tidy-19");
  if (exact) return exact;
  const other = which("clang-tidy");
  const version = other ? versionIn(output(other, ["--version"])) : undefined;
  return version && atLeast(version, [16, 0, 0]) ? other : undefined;
}

/** Returns a clang with libFuzzer's runtime, or undefined. */
export function findFuzzer() {
  const versions = Array.from({ length: 10 }, (_, i) => `clang++-${23 - i}`);
  const names = process.env.CXX ? [process.env.CXX] : ["clang++", ...versions];
  return names
    .map((name) => (path.isAbsolute(name) ? name : which(name)))
    .find((program) => program !== undefined && linksFuzzer(program));
}

/** Returns whether clang finds the runtime: it prints only the file name if it does not. */
function linksFuzzer(program) {
  const machine = { x64: "x86_64", arm64: "aarch64" }[process.arch] ?? process.arch;
  const names = [`libclang_rt.fuzzer-${machine}.a`, "libclang_rt.fuzzer.a", "libclang_rt.fuzzer_osx.a"];
  return names.some((name) => {
    const file = output(program, [`-print-file-name=${name}`])?.trim();
    return file !== undefined && file !== name && existsSync(file);
  });
}

/** Returns the prefix of a GoogleTest that CMake's find_package finds, or undefined. */
export function findGoogleTest() {
  const own = [process.env.GTest_ROOT, ...(process.env.CMAKE_PREFIX_PATH ?? "").split(path.delimiter)];
  const prefixes = [...own.filter(Boolean), "/usr", "/usr/local", "/opt/homebrew", "/opt/local"];
  return prefixes.find((prefix) => existsSync(path.join(prefix, "include", "gtest", "gtest.h")));
}

/** Returns the system's folder that contains glm/glm.hpp, or undefined. */
export function findSystemGlm() {
  const own = process.env.GLM_INCLUDE ? [process.env.GLM_INCLUDE] : [];
  const folders = [
    ...own,
    "/usr/include",
    "/usr/local/include",
    "/opt/homebrew/include",
    "/opt/local/include",
  ];
  return folders.find((folder) => existsSync(path.join(folder, "glm", "glm.hpp")));
}

/**
 * Returns Chromium for the end-to-end tests: $CHROMIUM, on PATH, in the usual folders, or in Playwright's cache.
 * Debian's headless shell comes first: Chromium without its own windows, whose toolbars cost a quarter of the time.
 */
export function findChromium() {
  const named = process.env.CHROMIUM;
  if (named) return isExecutable(named) ? named : undefined;
  const names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
  const onPath = which("chromium-headless-shell", ...names);
  if (onPath) return onPath;
  const applications = ["Google Chrome", "Chromium"].map(
    (app) => `/Applications/${app}.app/Contents/MacOS/${app}`,
  );
  return [...applications, ...playwrightBrowsers()].find(isExecutable);
}

function playwrightBrowsers() {
  const cache =
    process.env.PLAYWRIGHT_BROWSERS_PATH ??
    (process.platform === "darwin"
      ? path.join(homedir(), "Library", "Caches", "ms-playwright")
      : path.join(homedir(), ".cache", "ms-playwright"));
  if (!existsSync(cache)) return [];
  const inside = [
    "chrome-linux/chrome",
    "chrome-linux64/chrome",
    "chrome-mac/Chromium.app/Contents/MacOS/Chromium",
    "chrome-mac-arm64/Chromium.app/Contents/MacOS/Chromium",
  ];
  return readdirSync(cache)
    .filter((name) => /^chromium-\d+$/.test(name))
    .sort()
    .reverse()
    .flatMap((name) => inside.map((program) => path.join(cache, name, program)));
}

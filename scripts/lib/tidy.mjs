import { spawn } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { filesUnder, hashOf, isFresh, markFresh } from "./fresh.mjs";
import { buildFolders, glmFolder, inRoot, root } from "./paths.mjs";
import { inParallel, say } from "./run.mjs";
import { findTidy } from "./tools.mjs";

/** Folder of the compile commands for clang-tidy. */
const databaseFolder = inRoot("build", "tidy");

/** Warnings of clang that .clang-tidy lists as checks. */
const CLANG_WARNINGS = ["-Wreserved-identifier", "-Wsuggest-override", "-Wzero-as-null-pointer-constant"];

/**
 * Runs clang-tidy on the engine, one module of the unity build at a time, and on the native programs. A module is
 * checked again only if one of its sources, any header or the rules changed. Returns the names of modules and
 * programs with warnings.
 */
export async function tidy() {
  const program = findTidy();
  const headers = filesUnder([inRoot("cpp")]).filter((file) => file.endsWith(".h"));
  const shared = hashOf([inRoot(".clang-tidy"), inRoot("cpp", "CMakeLists.txt"), ...headers]);
  const bad = await inParallel(unitsToCheck(), async (file) => {
    const name = path.basename(file);
    const stamp = path.join(databaseFolder, `${name}.stamp`);
    const hash = `${program} ${shared} ${hashOf([file, ...sourcesIn(file)])}`;
    if (isFresh(stamp, hash)) return [];
    if (!(await isTidy(program, file))) return [name];
    markFresh(stamp, hash);
    return [];
  });
  return bad.flat();
}

/** Writes the compile commands without the options that only GCC understands; returns the sources to check. */
function unitsToCheck() {
  const entries = JSON.parse(readFileSync(path.join(buildFolders.release, "compile_commands.json"), "utf8"));
  const commands = entries.map((entry) => ({
    ...entry,
    // Clang cannot read GCC's precompiled headers; each source includes what it needs.
    command: entry.command
      .replaceAll(" -fno-tree-loop-vectorize", "")
      .replaceAll(/ -include \S+cmake_pch\.hxx/g, "")
      .replaceAll(" -Winvalid-pch", "")
      .replaceAll(" -Wno-subobject-linkage", ""),
  }));
  mkdirSync(databaseFolder, { recursive: true });
  writeFileSync(path.join(databaseFolder, "compile_commands.json"), JSON.stringify(commands, null, 1));
  const files = commands.map((entry) => path.resolve(entry.directory, entry.file));
  const isOurs = (file) =>
    /[/\\]tetrafront\.dir[/\\]Unity[/\\]/.test(file) || file.startsWith(inRoot("cpp", "app"));
  return [...new Set(files.filter(isOurs))].sort();
}

/** Returns the sources that a unity source includes. */
function sourcesIn(unit) {
  return [...readFileSync(unit, "utf8").matchAll(/^#include "([^"]+\.cpp)"/gm)].map((match) =>
    path.resolve(root, match[1]),
  );
}

/** Runs clang-tidy on one source and prints its warnings, without the count of suppressed ones. */
function isTidy(program, file) {
  // GCC's std::stable_sort uses functions that C++17 deprecates; GCC does not warn about its own headers.
  const options = [`-isystem${glmFolder}`, "-Wno-deprecated-declarations", ...CLANG_WARNINGS];
  const extra = options.map((option) => `--extra-arg=${option}`);
  const args = ["--quiet", "-p", databaseFolder, ...extra, file];
  return new Promise((resolve, reject) => {
    const child = spawn(program, args, { cwd: root, stdio: ["ignore", "pipe", "ignore"] });
    let text = "";
    child.stdout.on("data", (chunk) => (text += chunk));
    child.on("error", reject);
    child.on("close", (status) => {
      if (status !== 0) say(text);
      resolve(status === 0);
    });
  });
}

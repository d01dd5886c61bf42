import { spawn } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { filesUnder, hashOf, isFresh, markFresh } from "./fresh.mjs";
import { buildFolders, glmFolder, inRoot, root } from "./paths.mjs";
import { inParallel, say } from "./run.mjs";
import { findTidy } from "./tools.mjs";

/**
 * clang-tidy over every source the native build compiles. A file is checked again only when it, any header
 * or the rules changed. Returns the names of files with findings.
 */
export async function tidy() {
  const program = findTidy();
  const sources = commandsForClang()
    .map((entry) => path.resolve(entry.directory, entry.file))
    .filter((file) => file.startsWith(inRoot("cpp") + path.sep));
  const headers = filesUnder([inRoot("cpp")]).filter((file) => file.endsWith(".h"));
  const shared = hashOf([inRoot(".clang-tidy"), inRoot("cpp", "CMakeLists.txt"), ...headers]);
  const files = [...new Set(sources)].sort();
  const bad = await inParallel(files, async (file) => {
    const stamp = inRoot("build", "tidy", path.relative(root, file).replaceAll(path.sep, "__"));
    const hash = `${program} ${shared} ${hashOf([file])}`;
    if (isFresh(stamp, hash)) return [];
    if (!(await isTidy(program, file))) return [path.relative(root, file)];
    markFresh(stamp, hash);
    return [];
  });
  return bad.flat();
}

/** Where clang-tidy reads how files are compiled. */
const databaseFolder = inRoot("build", "tidy");

/** The native build's commands less the options that only GCC knows, written where clang-tidy looks. */
function commandsForClang() {
  const entries = JSON.parse(readFileSync(path.join(buildFolders.release, "compile_commands.json"), "utf8"));
  const commands = entries.map((entry) => ({
    ...entry,
    command: entry.command.replaceAll(" -fno-tree-loop-vectorize", ""),
  }));
  mkdirSync(databaseFolder, { recursive: true });
  writeFileSync(path.join(databaseFolder, "compile_commands.json"), JSON.stringify(commands, null, 1));
  return commands;
}

/** Runs clang-tidy on one file and shows its findings, without its count of suppressed warnings. */
function isTidy(program, file) {
  // GCC's std::stable_sort uses what C++17 deprecates; GCC does not warn of its own headers.
  const extra = [`-isystem${glmFolder}`, "-Wno-deprecated-declarations"].map((arg) => `--extra-arg=${arg}`);
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

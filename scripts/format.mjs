// Formats all files (--write) or lists those that are not formatted (--check, the default): TypeScript, JSON and
// Markdown with oxfmt, C++ with clang-format. Both come from the lockfile, so all machines agree.
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { filesUnder } from "./lib/fresh.mjs";
import { ensurePackages } from "./lib/npm.mjs";
import { inRoot, root } from "./lib/paths.mjs";
import { main, run, say } from "./lib/run.mjs";

export function cppFiles() {
  const places = ["cpp", "wasm", "tests"].map((room) => inRoot(room));
  return filesUnder(places).filter((file) => /\.(h|cpp)$/.test(file));
}

/** Returns whether all files were formatted already; `write` formats them. */
export async function formatScript(write) {
  const program = inRoot("node_modules", ".bin", "oxfmt");
  return (await run(program, [write ? "--write" : "--list-different", root], { quietOut: true })) === 0;
}

export async function formatCpp(write) {
  const { default: load, format } = await import("@wasm-fmt/clang-format");
  await load();
  const style = readFileSync(inRoot(".clang-format"), "utf8");
  let clean = true;
  for (const file of cppFiles()) {
    const text = readFileSync(file, "utf8");
    const formatted = format(text, path.basename(file), style);
    if (formatted === text) continue;
    if (write) writeFileSync(file, formatted);
    else say(`not formatted: ${path.relative(root, file)}`);
    clean = false;
  }
  return clean;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await main(async () => {
    await ensurePackages();
    const write = process.argv.includes("--write");
    const script = await formatScript(write);
    const cpp = await formatCpp(write);
    if (!write && !(script && cpp)) process.exitCode = 1;
  });
}

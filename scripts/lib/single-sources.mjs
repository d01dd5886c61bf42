import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { filesUnder, hashOf, isFresh, markFresh } from "./fresh.mjs";
import { glmFolder, inRoot } from "./paths.mjs";
import { inParallel, run, UserError } from "./run.mjs";
import { findFuzzer } from "./tools.mjs";

const folder = inRoot("build", "alone");

/** As in cpp/CMakeLists.txt. */
const FLAGS = ["-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror"];

/**
 * How a compiler makes a file of read headers and uses it. Clang also keeps what it has made of their templates, and so needs less of
 * the processor than GCC. GCC's std::stable_sort uses functions that C++17 deprecates; GCC does not warn about its own headers.
 */
const ways = {
  clang: {
    flags: ["-Wno-deprecated-declarations", "-fpch-instantiate-templates"],
    made: (header) => `${header}.pch`,
    use: (header) => ["-include-pch", `${header}.pch`],
  },
  gcc: {
    flags: [],
    made: (header) => `${header}.gch`,
    use: (header) => ["-include", header],
  },
};

/** Headers that are read once for all sources: reading them takes half of the time. */
const COMMON = [
  "algorithm",
  "array",
  "bit",
  "chrono",
  "cmath",
  "compare",
  "coroutine",
  "cstddef",
  "cstdint",
  "cstring",
  "exception",
  "functional",
  "initializer_list",
  "iterator",
  "limits",
  "map",
  "memory",
  "numbers",
  "numeric",
  "optional",
  "ranges",
  "set",
  "span",
  "stdexcept",
  "string_view",
  "tuple",
  "type_traits",
  "utility",
  "variant",
  "vector",
];

/**
 * Compiles each source of the engine alone, without making code: all other builds compile a module as one source, which hides
 * missing includes and names that are used twice. Returns the sources that cannot be compiled.
 */
export async function sourcesThatNeedOthers(usual) {
  const compiler = findFuzzer() ?? usual;
  const way = /clang/.test(path.basename(compiler)) ? ways.clang : ways.gcc;
  const files = filesUnder([inRoot("cpp", "src"), inRoot("cpp", "include")]);
  const stamp = path.join(folder, "stamp");
  const hash = `${compiler} ${hashOf(files)}`;
  if (isFresh(stamp, hash)) return [];
  mkdirSync(folder, { recursive: true });
  const common = path.join(folder, "common.h");
  const names = [...COMMON, "glm/glm.hpp"];
  writeFileSync(common, names.map((name) => `#include <${name}>\n`).join(""));
  const flags = [
    ...FLAGS,
    ...way.flags,
    `-I${inRoot("cpp", "include")}`,
    `-I${inRoot("cpp", "src")}`,
    "-isystem",
    glmFolder,
  ];
  const made = await run(compiler, [...flags, "-x", "c++-header", common, "-o", way.made(common)]);
  if (made !== 0) throw new UserError(`${compiler} cannot compile ${common}`);
  const sources = files.filter((file) => file.endsWith(".cpp"));
  const bad = await inParallel(sources, async (source) => {
    const status = await run(compiler, [...flags, ...way.use(common), "-fsyntax-only", source]);
    return status === 0 ? [] : [path.relative(inRoot("cpp", "src"), source)];
  });
  if (bad.flat().length === 0) markFresh(stamp, hash);
  return bad.flat();
}

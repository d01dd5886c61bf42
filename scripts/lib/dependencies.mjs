import { readFileSync } from "node:fs";
import path from "node:path";
import { filesUnder } from "./fresh.mjs";
import { inRoot, root } from "./paths.mjs";

/** The modules of cpp/src from the bottom up (docs/ARCHITECTURE.md): a module may include those on lower levels. */
const levels = [
  ["base"],
  ["geom"],
  ["search"],
  ["field", "model", "fill"],
  ["quality"],
  ["boundary"],
  ["sizing"],
  ["surface", "volume", "optimize"],
  ["preview"],
  ["repair"],
];
const levelOf = new Map(levels.flatMap((modules, level) => modules.map((module) => [module, level])));

/** Returns the includes that violate the dependency rule, one sentence each. */
export function wrongIncludes() {
  const folder = inRoot("cpp", "src");
  return filesUnder([folder])
    .filter((file) => /\.(h|cpp)$/.test(file))
    .flatMap((file) => {
      const module = path.relative(folder, file).split(path.sep)[0];
      return includesOf(file)
        .filter((include) => !mayInclude(module, include.split("/")[0]))
        .map((include) => `${path.relative(root, file)} includes ${include}, which is not below ${module}/`);
    });
}

function includesOf(file) {
  return [...readFileSync(file, "utf8").matchAll(/^\s*#\s*include\s+"([^"]+)"/gm)].map((match) => match[1]);
}

/** Files directly in cpp/src (mesher.cpp) may include all modules; every module may include the public headers. */
function mayInclude(module, other) {
  if (module.endsWith(".cpp") || other === "tetrafront" || module === other) return true;
  return levelOf.has(module) && levelOf.has(other) && levelOf.get(other) < levelOf.get(module);
}

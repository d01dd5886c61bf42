import { readFileSync } from "node:fs";
import path from "node:path";
import { filesUnder } from "./fresh.mjs";
import { inRoot, root } from "./paths.mjs";

/** The rooms of cpp/src from the bottom up (docs/ARCHITECTURE.md): a room may include those on lower floors. */
const floors = [
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
const floorOf = new Map(floors.flatMap((rooms, floor) => rooms.map((room) => [room, floor])));

/** Includes that point against the arrows, as "file: include" in words; empty when all is well. */
export function wrongIncludes() {
  const folder = inRoot("cpp", "src");
  return filesUnder([folder])
    .filter((file) => /\.(h|cpp)$/.test(file))
    .flatMap((file) => {
      const room = path.relative(folder, file).split(path.sep)[0];
      return includesOf(file)
        .filter((include) => !mayInclude(room, include.split("/")[0]))
        .map((include) => `${path.relative(root, file)} includes ${include}, which is not below ${room}/`);
    });
}

function includesOf(file) {
  return [...readFileSync(file, "utf8").matchAll(/^\s*#\s*include\s+"([^"]+)"/gm)].map((match) => match[1]);
}

/** Files directly in cpp/src (mesher.cpp) stand above all rooms; the public headers are for everyone. */
function mayInclude(room, other) {
  if (room.endsWith(".cpp") || other === "tetrafront" || room === other) return true;
  return floorOf.has(room) && floorOf.has(other) && floorOf.get(other) < floorOf.get(room);
}

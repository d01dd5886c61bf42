import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import path from "node:path";

/**
 * Returns all files under the given files and folders, in a fixed order, without node_modules and build results.
 */
export function filesUnder(places, { skip = ["node_modules", "dist"] } = {}) {
  const found = [];
  const visit = (place) => {
    if (!existsSync(place)) return;
    if (!statSync(place).isDirectory()) {
      found.push(place);
      return;
    }
    for (const name of readdirSync(place).sort()) if (!skip.includes(name)) visit(path.join(place, name));
  };
  places.forEach(visit);
  return found;
}

/** Returns one hash over the names and contents of files. */
export function hashOf(files) {
  const hash = createHash("sha256");
  for (const file of files) hash.update(file).update("\0").update(readFileSync(file)).update("\0");
  return hash.digest("hex");
}

/** Returns whether `stampFile` records the same inputs. */
export function isFresh(stampFile, hash) {
  return existsSync(stampFile) && readFileSync(stampFile, "utf8") === hash;
}

export function markFresh(stampFile, hash) {
  mkdirSync(path.dirname(stampFile), { recursive: true });
  writeFileSync(stampFile, hash);
}

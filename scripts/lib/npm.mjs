import { createHash } from "node:crypto";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { inRoot } from "./paths.mjs";
import { must, say } from "./run.mjs";

const stampFile = inRoot("node_modules", ".installed-from");

/** Installs the npm packages of the lockfile, unless node_modules contains exactly those. */
export async function ensurePackages() {
  const stamp = lockStamp();
  if (existsSync(stampFile) && readFileSync(stampFile, "utf8") === stamp) return;
  if (holdsLocked()) {
    writeFileSync(stampFile, stamp);
    return;
  }
  say("setup: installing npm packages from package-lock.json");
  // Playwright must not download a browser; the system provides one.
  const env = { PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD: "1" };
  const npm = process.platform === "win32" ? "npm.cmd" : "npm";
  await must(npm, ["ci", "--no-audit", "--no-fund", "--loglevel=error"], { env, quietOut: true });
  writeFileSync(stampFile, lockStamp());
}

/** Returns the hash of the lockfile with the platform: native parts of a package differ between platforms. */
function lockStamp() {
  const lock = createHash("sha256")
    .update(readFileSync(inRoot("package-lock.json")))
    .digest("hex");
  return `${lock} ${process.platform} ${process.arch}\n`;
}

/**
 * After a manual `npm install NAME` the packages are right without a reinstallation; npm's own record shows it.
 */
function holdsLocked() {
  const record = inRoot("node_modules", ".package-lock.json");
  if (!existsSync(record)) return false;
  const installed = JSON.parse(readFileSync(record, "utf8")).packages;
  const locked = JSON.parse(readFileSync(inRoot("package-lock.json"), "utf8")).packages;
  return Object.entries(locked).every(([place, entry]) => {
    if (place === "" || entry.link || !place.includes("node_modules")) return true;
    if (installed[place] === undefined) return entry.optional === true;
    return installed[place].version === entry.version && existsSync(path.join(inRoot(), place));
  });
}

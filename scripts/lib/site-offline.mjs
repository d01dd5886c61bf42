// Writes sw.js, the service worker of the built site: web/service-worker.ts with the list of the site's files.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { build } from "esbuild";
import { filesUnder } from "./fresh.mjs";
import { whenWritten } from "./site-written.mjs";

/** Files that no page requests by name: source maps, compressed copies, and the formats of fonts for browsers without WebAssembly. */
const unused = /\.(map|br)$|\.(woff|ttf)$|^sw\.js$/;
/** Large files that many never need: the libraries that read CAD files. They are kept when they are used, or on request. */
const later = /^assets\/(occt-import-js|replicad_single)-/;

/** Returns `{ version, files }`: what the service worker keeps of a built site. */
export function siteFiles(folder) {
  const hash = createHash("sha256");
  const files = [];
  for (const file of filesUnder([folder], { skip: [] }).sort()) {
    const name = path.relative(folder, file).split(path.sep).join("/");
    if (unused.test(name)) continue;
    const content = readFileSync(file);
    const sha256 = createHash("sha256").update(content).digest("hex");
    hash.update(`${name} ${sha256}\n`);
    files.push({
      // Pages are known by their folders: some hosts redirect from their names.
      path: `./${name.replace(/(^|\/)index\.html$/, "$1")}`,
      bytes: content.length,
      // Names of the others change with their content.
      ...(!name.startsWith("assets/") && { sha256 }),
      isLater: later.test(name),
    });
  }
  return { version: hash.digest("hex").slice(0, 16), files };
}

/** @param source the service worker in TypeScript. */
export function offlineSite({ source }) {
  return {
    name: "tetrafront:offline-site",
    apply: "build",
    ...whenWritten(async (folder) => {
      const site = siteFiles(folder);
      const { outputFiles } = await build({
        entryPoints: [source],
        bundle: true,
        minify: true,
        write: false,
        format: "iife",
        target: "es2023",
        define: { SITE: JSON.stringify(site) },
      });
      writeFileSync(path.join(folder, "sw.js"), outputFiles[0].contents);
    }),
  };
}

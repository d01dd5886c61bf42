// Writes THIRD-PARTY-NOTICES.txt into the built site, from the modules that were really bundled.
import { readFileSync } from "node:fs";
import { inRoot } from "./paths.mjs";
import { ENGINE_PARTS, noticesText } from "./notices.mjs";

/** Returns the plugin of the pages; its `ofWorker` returns one for a worker, which is bundled separately. */
export function thirdPartyNotices() {
  const modules = new Set();
  const note = (context) => {
    for (const id of context.getModuleIds()) modules.add(id);
  };
  // Styles import others, which are no modules, and name fonts of packages.
  const noteStyles = (_code, id) => {
    if (!/\.css$/.test(id)) return null;
    modules.add(id);
    // Styles within a page have no file.
    if (id.includes("?")) return null;
    for (const [, font] of readFileSync(id, "utf8").matchAll(/url\("(@[^"]+)"\)/g))
      modules.add(inRoot("node_modules", font));
    return null;
  };
  return {
    name: "tetrafront:third-party-notices",
    apply: "build",
    transform: noteStyles,
    generateBundle() {
      note(this);
      const source = noticesText(modules, ENGINE_PARTS, "This site");
      this.emitFile({ type: "asset", fileName: "THIRD-PARTY-NOTICES.txt", source });
      this.emitFile({
        type: "asset",
        fileName: "LICENSE.txt",
        source: readFileSync(inRoot("LICENSE"), "utf8"),
      });
    },
    ofWorker: () => ({
      name: "tetrafront:third-party-notices-of-worker",
      buildEnd() {
        note(this);
      },
    }),
  };
}

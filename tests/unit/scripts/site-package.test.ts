import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import { UNUSED_CALLS, withoutUnusedCalls } from "../../../scripts/lib/site-package.mjs";

const root = path.resolve(import.meta.dirname, "../../..");
const mesher = readFileSync(path.join(root, "wasm/dist/api/mesher.js"), "utf8");

/** Returns the sources in a folder of the repository, by name. */
const sourcesIn = (...folder: string[]): readonly (readonly [name: string, text: string])[] =>
  readdirSync(path.join(root, ...folder), { recursive: true })
    .map(String)
    .filter((name) => /\.tsx?$/.test(name) && !/^(dist|node_modules)\b/.test(name))
    .map((name) => [name, readFileSync(path.join(root, ...folder, name), "utf8")]);

describe("the package of the site", () => {
  it("is without the calls of a mesher that nothing makes", () => {
    const left = withoutUnusedCalls(mesher);
    for (const file of ["adaptation-cycles", "layers", "surface-meshing"]) {
      expect(mesher).toContain(`./${file}.js`);
      expect(left).not.toContain(`./${file}.js`);
    }
    expect(left.length).toBeGreaterThan(mesher.length - 300);
    const made = /\b(?:mesher|app\.mesher\)|promise)\.(\w+)\(/g;
    let calls = 0;
    for (const [name, text] of [...sourcesIn("web"), ...sourcesIn("wasm/src/api")]) {
      // `meshFile` and the adaptation by a solver of the caller are not in the site.
      if (["mesh-file.ts", "adaptation-cycles.ts", "surface-mesher.ts"].includes(name)) continue;
      for (const [, call = ""] of text.replaceAll(/^ *\*.*$/gm, "").matchAll(made)) {
        expect(Object.keys(UNUSED_CALLS), name).not.toContain(call);
        calls++;
      }
      expect(text, name).not.toMatch(/\b(meshFile|createSurfaceMesher)\b.*from "tetrafront"/);
    }
    expect(calls).toBeGreaterThan(20);
  });

  it("must be the version whose imports are known", () => {
    expect(() => withoutUnusedCalls("export {};")).toThrow("site-package.mjs");
  });
});

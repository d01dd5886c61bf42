/** The files that `npm publish` uploads, and their use after installation. */
import { execFile, execFileSync } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  renameSync,
  statSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { gzipSync } from "node:zlib";

import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { typescriptCompiler } from "../../../scripts/lib/tools.mjs";
import { freshInstall, npm, type FreshInstall } from "../../support/fresh-install.js";
import { boxSolid, stepFile } from "../../support/step-files.js";
import { stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

const run = promisify(execFile);
const root = fileURLToPath(new URL("../../..", import.meta.url));
const bin = (name: string) => path.join(root, "node_modules", ".bin", name);

let fresh: FreshInstall;
beforeAll(() => {
  fresh = freshInstall();
});
afterAll(() => fresh.dispose());

const installed = (...names: string[]) => path.join(fresh.folder, "node_modules", "tetrafront", ...names);

function filesIn(folder: string): string[] {
  return readdirSync(folder, { recursive: true, encoding: "utf8" })
    .filter((name) => statSync(path.join(folder, name)).isFile())
    .map((name) => name.replaceAll("\\", "/"));
}

/**
 * Returns scripts and all that they import at once. Formats and tools are in separate files, which a page fetches when it
 * needs one of them (tests/e2e/package.spec.ts).
 */
function importedBy(...names: readonly string[]): ReadonlySet<string> {
  const found = new Set<string>(names);
  for (const name of found) {
    const text = readFileSync(installed(name), "utf8");
    for (const [, imported = ""] of text.matchAll(/\b(?:from|import)\s*"\.\/([^"]+\.js)"/g)) {
      found.add(`dist/page/${imported}`);
    }
  }
  return found;
}

describe("the packed files", () => {
  test("are the required ones; each script has its types and its source map", () => {
    const files = filesIn(installed()).filter((name) => !name.startsWith("node_modules/"));
    // Servers and bundlers that do not support .mjs must find every file they need.
    expect(files.filter((name) => /\.m[jt]s$/.test(name))).toEqual(["bin/tetrafront.mjs"]);
    const generated = [
      "dist/project.schema.json",
      ...["engine", "tools", "trace", "plane"].flatMap((name) =>
        ["js", "d.ts", "wasm"].map((type) => `dist/engine/${name}.${type}`),
      ),
    ];
    const scripts = files.filter((name) => /^dist\/.*\.js$/.test(name) && !generated.includes(name));
    const expected = scripts.flatMap((name) =>
      name.startsWith("dist/page/")
        ? [name, `${name}.map`]
        : [name, `${name}.map`, name.replace(/\.js$/, ".d.ts")],
    );
    const others = ["LICENSE", "README.md", "THIRD-PARTY-NOTICES.txt", "package.json", "bin/tetrafront.mjs"];
    expect(files.sort()).toEqual([...expected, ...others, ...generated].sort());
  });

  test("name what they contain of others, with licences", () => {
    const notices = readFileSync(installed("THIRD-PARTY-NOTICES.txt"), "utf8");
    for (const name of ["fflate 0", "valibot 1", "GLM", "musl", "LLVM", "Emscripten"])
      expect(notices).toMatch(new RegExp(`^ {2}${name}.*: (MIT|Apache-2\\.0)`, "m"));
    expect(notices).toContain("Permission is hereby granted, free of charge");
    expect(notices).toContain("LLVM Exceptions to the Apache 2.0 License");
  });

  test("have source maps with source content", () => {
    const map = JSON.parse(readFileSync(installed("dist/api/mesher.js.map"), "utf8")) as {
      readonly sourcesContent: readonly string[];
    };
    expect(map.sourcesContent[0]).toContain("class WorkerMesher");
  });

  test("let a page mesh a surface with less than 528 kB compressed: engine, API and worker", () => {
    const engine = ["engine.wasm", "engine.js", "loader.js"].map((name) => `dist/engine/${name}`);
    const page = [...importedBy("dist/page/tetrafront.js", "dist/page/worker.js")];
    const bytes = [...engine, ...page].map((name) => gzipSync(readFileSync(installed(name))).length);
    expect(page.length).toBeGreaterThan(10);
    expect(bytes.reduce((sum, size) => sum + size)).toBeLessThan(528_000);
  });

  test("pass publint, Are The Types Wrong, and a dry run of npm publish", async () => {
    await run(bin("publint"), [fresh.tarball, "--level", "warning", "--strict"]);
    await run(bin("attw"), [fresh.tarball, "--profile", "esm-only"]);
    const output = execFileSync("npm", ["publish", "--dry-run", "--access", "public", "--tag", "next"], {
      cwd: path.join(root, "wasm"),
      encoding: "utf8",
      stdio: ["ignore", "pipe", "pipe"],
    });
    expect(output).toContain("tetrafront@");
    expect(npm(["pkg", "get", "name"], path.join(root, "wasm"))).toContain("tetrafront");
  });
});

describe("after installation into an empty folder", () => {
  test("importing the package creates no globals and starts nothing", async () => {
    const program = `const before = new Set(Object.getOwnPropertyNames(globalThis));
      await import("tetrafront");
      const after = Object.getOwnPropertyNames(globalThis).filter((name) => !before.has(name));
      console.log(JSON.stringify([after, process.getActiveResourcesInfo().filter((what) => /Worker|Time/.test(what))]));`;
    const args = ["--input-type=module", "-e", program];
    const { stdout } = await run(process.execPath, args, { cwd: fresh.folder });
    const [globals, resources] = JSON.parse(stdout) as [string[], string[]];
    expect(globals).toEqual([]);
    expect(resources).toEqual([]);
  });

  test("its types compile strictly without the types of browsers, including library checks", async () => {
    const program = `import { createMesher, readSurface, type Mesher } from "tetrafront";
      import type { MesherError } from "tetrafront/page";
      export const filled = async (mesher: Mesher, bytes: Uint8Array): Promise<number> => {
        const read = await readSurface(bytes, { fileName: "part.stl" });
        return read.success ? (await mesher.fillSurface(read.value)).mesh.regions.length : read.errors.length;
      };
      export const own = createMesher().catch((failure: MesherError) => failure.code);`;
    writeFileSync(path.join(fresh.folder, "program.ts"), program);
    const settings = ["--strict", "--noEmit", "--skipLibCheck", "false", "--module", "nodenext"];
    const known = ["--target", "es2022", "--lib", "es2022", "--types", "node"];
    const types = ["--typeRoots", path.join(root, "node_modules", "@types")];
    const args = [typescriptCompiler, "program.ts", "--ignoreConfig", ...settings, ...known, ...types];
    const { stdout } = await run(process.execPath, args, { cwd: fresh.folder });
    expect(stdout).toBe("");
  });

  test("the command line runs", async () => {
    writeFileSync(path.join(fresh.folder, "part.stl"), stlBinary(boxSurface(2)));
    const command = path.join(fresh.folder, "node_modules", ".bin", "tetrafront");
    const args = ["mesh", "part.stl", "-o", "part.vtu", "--report", "-", "-q"];
    const program = process.platform === "win32" ? installed("bin", "tetrafront.mjs") : command;
    const { stdout } = await run(process.execPath, [program, ...args], { cwd: fresh.folder });
    expect(JSON.parse(stdout)).toMatchObject({ status: "done" });
  });

  test("without the optional libraries, a CAD file gives an error that says how to install it", async () => {
    const inside = (folder: string, name: string) => path.join(fresh.folder, folder, name);
    const libraries = ["occt-import-js", "replicad-opencascadejs"].filter((name) =>
      existsSync(inside("node_modules", name)),
    );
    mkdirSync(path.join(fresh.folder, "elsewhere"));
    for (const name of libraries) renameSync(inside("node_modules", name), inside("elsewhere", name));
    writeFileSync(path.join(fresh.folder, "part.step"), stepFile([boxSolid("box", [0, 0, 0], [1, 1, 1])]));
    const args = [installed("bin", "tetrafront.mjs"), "mesh", "part.step", "-o", "part.vtu"];
    const failure = (await run(process.execPath, args, { cwd: fresh.folder }).catch(
      (error: unknown) => error,
    )) as { readonly code: number; readonly stderr: string };
    for (const name of libraries) renameSync(inside("elsewhere", name), inside("node_modules", name));
    expect(failure.code).toBe(2);
    expect(failure.stderr).toMatch(
      /error: part\.step: STEP files need the library replicad-opencascadejs or occt-import-js, which could not be loaded: .*\. Install .*: npm install replicad-opencascadejs/,
    );
  });

  describe("in a folder made by npm init -y", () => {
    const made = (name: string) => {
      const folder = path.join(fresh.folder, name);
      mkdirSync(folder);
      npm(["init", "-y"], folder);
      symlinkSync(path.join(fresh.folder, "node_modules"), path.join(folder, "node_modules"));
      writeFileSync(path.join(folder, "part.stl"), stlBinary(boxSurface(2)));
      return folder;
    };

    test("the script in the README meshes a part", async () => {
      const folder = made("esm");
      const [, script = ""] = /^```js\n(.*?)^```/ms.exec(readFileSync(installed("README.md"), "utf8")) ?? [];
      writeFileSync(path.join(folder, "mesh.mjs"), script);
      const { stdout } = await run(process.execPath, ["mesh.mjs"], { cwd: folder });
      expect(stdout).toMatch(/^\d+ \{ min: /);
      expect(statSync(path.join(folder, "part.vtu")).size).toBeGreaterThan(1000);
    });

    test("a .js file can require the package", async () => {
      const folder = made("commonjs");
      const script = `const { createMesher } = require("tetrafront");
        const { readSurfaceFile } = require("tetrafront/node");
        async function main() {
          const file = await readSurfaceFile("part.stl");
          const mesher = await createMesher();
          const { report } = await mesher.fillSurface(file.value);
          console.log(report.status);
          mesher.dispose();
        }
        main();`;
      writeFileSync(path.join(folder, "mesh.js"), script);
      const { stdout } = await run(process.execPath, ["mesh.js"], { cwd: folder });
      expect(stdout).toBe("done\n");
    });
  });

  test("the example for Node meshes a part", async () => {
    const folder = fresh.example("node");
    writeFileSync(path.join(folder, "part.stl"), stlBinary(boxSurface(3)));
    const { stdout } = await run(process.execPath, ["mesh.mjs", "part.stl", "part.vtu"], { cwd: folder });
    expect(stdout).toMatch(/^\d+ tetrahedra, dihedral angles \d/);
    expect(statSync(path.join(folder, "part.vtu")).size).toBeGreaterThan(1000);
  });

  test("the example of a batch meshes many parts and reports an invalid one", async () => {
    const folder = fresh.example("batch");
    for (const name of ["parts", "meshes"]) mkdirSync(path.join(folder, name));
    for (const n of [1, 2, 3])
      writeFileSync(path.join(folder, "parts", `${n}.stl`), stlBinary(boxSurface(n)));
    writeFileSync(path.join(folder, "parts", "bad.stl"), "solid nothing");
    const { stdout } = await run(process.execPath, ["batch.mjs", "parts", "meshes"], { cwd: folder });
    expect(stdout.match(/"status":"done"/g)).toHaveLength(3);
    expect(stdout).toMatch(/^bad\.stl .*"status":"invalid-input"/m);
    expect(readdirSync(path.join(folder, "meshes")).sort()).toEqual(["1.vtu", "2.vtu", "3.vtu"]);
  });
});

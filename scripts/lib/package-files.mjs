import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { filesUnder, hashOf, isFresh, markFresh } from "./fresh.mjs";
import { ENGINE_PARTS, noticesText } from "./notices.mjs";
import { inRoot } from "./paths.mjs";

/** The modules of the compiled engine in dist/engine. */
export const MODULES = ["engine", "tools", "trace", "plane"];

/** Files in dist that are not compiled from TypeScript. */
const EMSCRIPTENS = new Set(
  MODULES.flatMap((module) => ["js", "d.ts", "wasm"].map((type) => path.join("engine", `${module}.${type}`))),
);

/** Removes the output of deleted sources: the compiler keeps it, and npm would pack it. */
export function dropOrphans() {
  const dist = inRoot("wasm", "dist");
  for (const file of filesUnder([dist], { skip: [] })) {
    const name = path.relative(dist, file);
    if (EMSCRIPTENS.has(name)) continue;
    const stem = /^(?!page)(.*?)\.(d\.m?ts|m?js|wasm)(\.map)?$/.exec(name)?.[1];
    const isOfNothing = /\.d\.ts\.map$/.test(name);
    if (stem !== undefined && (isOfNothing || !existsSync(inRoot("wasm", "src", `${stem}.ts`)))) rmSync(file);
  }
}

/** Writes the schema of project files as JSON Schema (draft 2020-12), for editors and other programs. */
export async function writeProjectSchema() {
  const { toJsonSchema } = await import("@valibot/to-json-schema");
  const inProject = (name) => import(pathToFileURL(inRoot("wasm", "dist", "project", name)).href);
  const [{ projectSchema }, { sharedSchemas }] = [
    await inProject("schema.js"),
    await inProject("feature-schema.js"),
  ];
  const schema = toJsonSchema(projectSchema, {
    target: "draft-2020-12",
    typeMode: "input",
    definitions: sharedSchemas,
    // JSON has only finite numbers and no references.
    ignoreActions: ["check", "finite", "raw_check", "readonly"],
  });
  writeFileSync(inRoot("wasm", "dist", "project.schema.json"), `${JSON.stringify(schema, undefined, 2)}\n`);
}

/** Minifies Emscripten's script of each module, unless it is minified already. Terser's result is a twelfth smaller than esbuild's. */
export async function minifyScripts() {
  const { minify } = await import("terser");
  for (const module of MODULES) {
    const script = inRoot("wasm", "dist", "engine", `${module}.js`);
    const stamp = inRoot("wasm", "dist", `.terser-${module}`);
    if (isFresh(stamp, hashOf([script]))) continue;
    const { code } = await minify(readFileSync(script, "utf8"), {
      module: true,
      ecma: 2020,
      compress: { passes: 3 },
    });
    writeFileSync(script, code);
    markFresh(stamp, hashOf([script]));
  }
}

/** Bundles everything that only the command line loads into one minified script, with a source map. */
export async function bundleCommandLine() {
  const { build } = await import("esbuild");
  const folder = inRoot("wasm", "dist", "cli");
  await build({
    // Bundle the sources: the compiler rewrites only files that changed.
    entryPoints: [inRoot("wasm", "src", "cli", "main.ts")],
    outfile: path.join(folder, "main.js"),
    bundle: true,
    format: "esm",
    platform: "node",
    target: "es2022",
    minify: true,
    sourcemap: true,
    logLevel: "warning",
    plugins: [
      {
        name: "command-line-only",
        setup({ onResolve }) {
          onResolve({ filter: /./ }, ({ kind, path: name }) =>
            kind === "entry-point" || name.startsWith("./") ? undefined : { external: true },
          );
        },
      },
    ],
  });
  for (const file of filesUnder([folder], { skip: [] })) {
    if (!path.basename(file).startsWith("main.")) rmSync(file);
  }
}

/**
 * Bundles the package for pages without a bundler: wasm/dist/page holds the API and the worker with all their
 * imports, and formats in files of their own, which are fetched when needed. The engine and its loader stay in
 * wasm/dist/engine, next to the .wasm file.
 */
export async function bundlePages() {
  const { build } = await import("esbuild");
  const dist = inRoot("wasm", "dist");
  const outdir = inRoot("wasm", "dist", "page");
  const { outputFiles, metafile } = await build({
    write: false,
    metafile: true,
    entryPoints: {
      tetrafront: `${dist}/page.js`,
      worker: `${dist}/engine/worker.js`,
      "tile-worker": `${dist}/engine/tile-worker.js`,
      "cad-worker": `${dist}/cad/cad-worker.js`,
    },
    outdir,
    bundle: true,
    splitting: true,
    format: "esm",
    platform: "browser",
    target: "es2022",
    minify: true,
    sourcemap: true,
    // The source maps point at the files of the package.
    sourcesContent: false,
    logLevel: "warning",
    plugins: [
      {
        name: "engine-beside",
        setup({ onResolve, onLoad }) {
          // The words are only for the JSON Schema, which is written already.
          onLoad({ filter: /\/project\/words\.js$/ }, () => ({ contents: "export const WORDS = {};" }));
          onResolve({ filter: /\/(plane-)?loader\.js$/ }, ({ path: name }) => ({
            path: `../engine/${path.basename(name)}`,
            external: true,
          }));
        },
      },
    ],
  });
  rmSync(outdir, { recursive: true, force: true });
  mkdirSync(outdir, { recursive: true });
  writePackageNotices(Object.keys(metafile.inputs).map((file) => path.resolve(file)));
  const named = plainChunkNames(outputFiles.map((file) => path.basename(file.path)));
  for (const file of outputFiles) {
    writeFileSync(path.join(outdir, named(path.basename(file.path))), named(file.text));
  }
}

/** Writes the licences of what the package contains of others: the modules bundled for pages, and parts of the engine. */
function writePackageNotices(modules) {
  const text = noticesText(modules, ENGINE_PARTS, "This package");
  writeFileSync(inRoot("wasm", "THIRD-PARTY-NOTICES.txt"), text);
}

/**
 * Replaces the hashes in the names of chunks by words of the same length, so that the source maps remain valid.
 * The files contain hundreds of these hashes, and hashes do not compress. A package needs none, because its entry
 * points have none.
 */
function plainChunkNames(files) {
  const chunks = files.filter((name) => CHUNK.test(name) && !name.endsWith(".map")).sort();
  const shared = chunks.filter((name) => name.startsWith("chunk-"));
  const words = new Map(
    chunks.map((name) => {
      const hash = CHUNK.exec(name)[1];
      const place = shared.indexOf(name);
      return [hash, place < 0 ? "deferred" : `shared${String(place).padStart(2, "0")}`];
    }),
  );
  return (text) =>
    text.replace(/-([A-Z0-9]{8})(?=\.js)/g, (all, hash) => (words.has(hash) ? `-${words.get(hash)}` : all));
}

const CHUNK = /-([A-Z0-9]{8})\.js/;

import { readFileSync } from "node:fs";
import path from "node:path";
import ts from "typescript";
import { filesUnder } from "./fresh.mjs";
import { inRoot, root } from "./paths.mjs";

/** The modules of cpp/src from the bottom up (docs/ARCHITECTURE.md): a module may include those on lower levels. */
const ENGINE = [
  ["base"],
  ["geom"],
  ["search", "topology"],
  ["metric"],
  ["field", "model", "fill"],
  ["quality"],
  ["boundary"],
  ["sizing", "lattice"],
  ["surface", "volume", "optimize", "curved", "arrangement", "placement", "solution"],
  ["preview"],
  ["repair", "remesh"],
  ["adapt"],
  ["layers"],
];

/**
 * The module of each public header: the one that implements it, or the lowest that uses its data. A header may include
 * those of its own and of lower modules; the same holds for the files of a module. `undefined` stands for the files
 * above all modules.
 */
const PUBLIC_HEADERS = {
  "vec3.h": "base",
  "sliced_tool.h": "base",
  "status.h": "base",
  "diagnostic_values.h": "base",
  "mesh.h": "base",
  "options.h": "field",
  "experiment.h": "field",
  "background_grid.h": "field",
  "grid_from_mesh.h": "field",
  "model.h": "model",
  "trimmed_model.h": "model",
  "node_placement.h": "placement",
  "quality_statistics.h": "quality",
  "mesh_inspection.h": "quality",
  "plane_fill.h": "surface",
  "mesh_adaptation.h": "adapt",
  "wall_layers.h": "layers",
  "mesh_improvement.h": "optimize",
  "second_order.h": "curved",
  "covering_grid.h": "preview",
  "size_samples.h": "preview",
  "solution.h": "solution",
  "curvature_samples.h": "preview",
  "size_proposals.h": "preview",
  "preview.h": "preview",
  "surface_tools.h": "repair",
  "region_location.h": "repair",
  "remesh.h": "remesh",
  "mesher.h": undefined,
  "run_check.h": undefined,
  "threads.h": undefined,
  "tile_host.h": undefined,
  "trace.h": undefined,
};

/** The modules of wasm/src, in the same way. */
const PACKAGE = [
  ["generated"],
  ["base"],
  ["diagnostics"],
  ["calls"],
  ["mesh", "cad"],
  ["formats"],
  ["project"],
  ["trace"],
  ["engine"],
  ["api"],
  ["cli"],
];

/** The modules of web/, in the same way. */
const APP = [
  ["strings", "expressions"],
  ["document", "ui"],
  ["workers"],
  ["solve"],
  ["session"],
  ["viewer"],
  ["tools"],
  ["app"],
  ["commands"],
  ["panels"],
  ["teach"],
];

/** The folders of web/panels, in the same way. */
const PANELS = [
  ["shared"],
  ["quality", "problems", "operations"],
  ["bodies"],
  ["entities", "model", "files", "background", "dialogs", "help", "solution"],
  ["viewport"],
  ["later"],
  ["inspector"],
  ["page"],
];

/** The folders of web/teach, in the same way. */
const TEACH = [["strings"], ["player"], ["article"], ["commands"], ["panels"], ["embed"]];

/** The folders whose imports have levels, by the name under which `npm run lint` reports them. */
export const layeredFolders = {
  "imports of the package": { folder: inRoot("wasm", "src"), modules: PACKAGE },
  "imports of the app": { folder: inRoot("web"), modules: APP },
  "imports of the panels": { folder: inRoot("web", "panels"), modules: PANELS },
  "imports of what teaches": { folder: inRoot("web", "teach"), modules: TEACH },
};

/** The layers of the engine. */
export const engineLayers = {
  sources: inRoot("cpp", "src"),
  modules: ENGINE,
  publicHeaders: inRoot("cpp", "include", "tetrafront"),
  moduleOfHeader: PUBLIC_HEADERS,
};

/** Returns the includes that violate the dependency rule, one sentence each. */
export function wrongIncludes({ sources, modules, publicHeaders, moduleOfHeader }) {
  const levels = levelsOf(modules);
  const isCode = (file) => /\.(h|cpp)$/.test(file);
  const headers = filesUnder([publicHeaders]).filter(isCode);
  const files = filesUnder([sources]).filter(isCode);
  const nameOf = (header) => path.relative(publicHeaders, header);
  const unplaced = headers
    .filter((header) => !(nameOf(header) in moduleOfHeader))
    .map((header) => `${path.relative(root, header)} has no module in PUBLIC_HEADERS`);
  const moved = Object.keys(moduleOfHeader)
    .filter((name) => !headers.some((header) => nameOf(header) === name))
    .map((name) => `PUBLIC_HEADERS lists ${name}, which does not exist`);
  const wrong = (file, module) =>
    includesOf(file)
      .filter((include) => {
        const [folder, ...rest] = include.split("/");
        if (folder !== "tetrafront") return !isAllowed(levels, module, folder);
        const name = rest.join("/");
        return name in moduleOfHeader && !isAllowed(levels, module, moduleOfHeader[name]);
      })
      .map((include) => sentence(file, "includes", include, module));
  return [
    ...unplaced,
    ...moved,
    ...headers.flatMap((header) => wrong(header, moduleOfHeader[nameOf(header)])),
    ...headers.flatMap(privateIncludes),
    ...files.flatMap((file) => wrong(file, moduleOf(sources, file))),
  ];
}

/** Users of the engine see only the public headers. */
function privateIncludes(header) {
  return includesOf(header)
    .filter((include) => !include.startsWith("tetrafront/"))
    .map((include) => `${path.relative(root, header)} includes ${include}, which is not public`);
}

/** Returns the imports that violate the dependency rule, and the cycles of files, one sentence each; types count too. */
export function wrongImports({ folder, modules }) {
  const levels = levelsOf(modules);
  const files = new Set(filesUnder([folder]).filter((file) => /\.tsx?$/.test(file)));
  const imports = new Map([...files].map((file) => [file, importsOf(file, files)]));
  const upward = [...files].flatMap((file) => {
    const module = moduleOf(folder, file);
    return imports
      .get(file)
      .filter((to) => !isAllowed(levels, module, moduleOf(folder, to)))
      .map((to) => sentence(file, "imports", path.relative(folder, to), module));
  });
  const cycles = cyclesIn(imports).map((cycle) => {
    const names = [...cycle, cycle[0]].map((file) => path.relative(folder, file));
    return `these files import each other: ${names.join(" → ")}`;
  });
  return [...upward, ...cycles];
}

function levelsOf(levels) {
  return new Map(levels.flatMap((modules, level) => modules.map((module) => [module, level])));
}

/** Returns the name of the folder in `folder` that holds the file; undefined for a file directly in it. */
function moduleOf(folder, file) {
  const [module, ...rest] = path.relative(folder, file).split(path.sep);
  return rest.length === 0 ? undefined : module;
}

/** Files in no module (mesher.cpp, index.ts) may use all modules; no module may use them. */
function isAllowed(levels, module, other) {
  if (module === undefined || module === other) return true;
  return levels.has(module) && levels.has(other) && levels.get(other) < levels.get(module);
}

function sentence(file, verb, other, module) {
  return `${path.relative(root, file)} ${verb} ${other}, which is not below ${module}/`;
}

function includesOf(file) {
  return [...readFileSync(file, "utf8").matchAll(/^\s*#\s*include\s+"([^"]+)"/gm)].map((match) => match[1]);
}

/** What an import may leave out of a file's path. */
const ENDINGS = ["", ".ts", ".tsx", `${path.sep}index.ts`];

/** Returns those of `files` that a TypeScript file imports by a relative path. */
function importsOf(file, files) {
  return ts
    .preProcessFile(readFileSync(file, "utf8"), true, true)
    .importedFiles.filter(({ fileName }) => fileName.startsWith("."))
    .map(({ fileName }) => path.resolve(path.dirname(file), fileName.replace(/\.js$/, "")))
    .flatMap((name) => ENDINGS.map((ending) => name + ending).filter((candidate) => files.has(candidate)));
}

/** Returns one cycle for each import that leads back to a file on the way to it. */
function cyclesIn(imports) {
  const cycles = [];
  const done = new Set();
  const visit = (file, way) => {
    if (done.has(file)) return;
    const begin = way.indexOf(file);
    if (begin >= 0) {
      cycles.push(way.slice(begin));
      return;
    }
    for (const next of imports.get(file)) visit(next, [...way, file]);
    done.add(file);
  };
  for (const file of imports.keys()) visit(file, []);
  return cycles;
}

// The scripts that every visit needs, in few files: each file is a request, and small ones compress badly.
import path from "node:path";

/** Modules that only hand on what others export, by the name under which they are imported. */
const HANDING = /^(?:tetrafront(?:\/\w+)?|@mantine\/(?:core|hooks|spotlight)|@tabler\/icons-react)$/;
const HANDED_ON =
  /[\\/](?:wasm[\\/]dist[\\/]\w+\.js|@mantine[\\/](?:core|hooks|spotlight)[\\/]esm[\\/]index\.mjs|tabler-icons-react\.mjs)$/;

/** Imports and exports with names: `import a, { b as c } from "d"`. */
const NAMED = /\b(?:import|export)\s*(?:[\w$]+\s*,\s*)?\{([^}]*)\}\s*from\s*["']([^"']+)["']/g;

/** Returns each imported or exported list: `names` as the other module has them, `own` as this one has. */
function namedIn(code) {
  return [...code.matchAll(NAMED)].map(([, list, from]) => {
    const pairs = list
      .split(",")
      .map((one) => one.trim().split(/\s+as\s+/))
      .filter(([name]) => name !== "");
    return { names: pairs.map(([name]) => name), own: pairs.map((pair) => pair.at(-1)), from };
  });
}

const ownersOf = new Map();

/** Returns the module in which a module that hands on has each name. */
function ownersIn(id, ctx) {
  let owners = ownersOf.get(id);
  if (owners !== undefined) return owners;
  owners = new Map();
  for (const { own, from } of namedIn(ctx.getModuleInfo(id)?.code ?? ""))
    for (const name of own) owners.set(name, path.resolve(path.dirname(id), from));
  ownersOf.set(id, owners);
  return owners;
}

/** Returns whether `id` is what an import of `from` leads to: `tetrafront/internal` to `internal.js`, others by their folder. */
function isImportOf(id, from) {
  if (!from.startsWith("tetrafront")) return id.replaceAll("\\", "/").includes(`/node_modules/${from}/`);
  return path.basename(id) === `${from.split("/")[1] ?? "index"}.js`;
}

/**
 * Returns what a module imports statically. Of modules that hand on, these are only the modules of the names that it
 * imports: the bundler leaves out the others, unless something else needs them, for example a reader of files when the first is read.
 */
function importedBy(id, ctx) {
  const { importedIds = [], code } = ctx.getModuleInfo(id) ?? {};
  const barrels = importedIds.filter((imported) => HANDED_ON.test(imported));
  if (barrels.length === 0) return importedIds;
  const named = namedIn(code ?? "").filter(({ from }) => HANDING.test(from));
  const owned = named.flatMap(({ names, from }) => {
    const barrel = barrels.find((imported) => isImportOf(imported, from));
    const owners = barrel === undefined ? new Map() : ownersIn(barrel, ctx);
    return names.map((name) => {
      const owner = owners.get(name);
      if (owner === undefined) throw new Error(`${id} imports ${name} of ${from}, which nothing hands on`);
      return owner;
    });
  });
  return [...importedIds.filter((imported) => !HANDED_ON.test(imported)), ...owned];
}

/** Returns what a module imports, statically or not. */
function allImports(id, ctx) {
  return [...importedBy(id, ctx), ...(ctx.getModuleInfo(id)?.dynamicallyImportedIds ?? [])];
}

/** Adds modules and all that they import. */
function addClosure(ids, ctx, importsOf = importedBy, found = new Set()) {
  for (const id of ids) {
    if (found.has(id)) continue;
    found.add(id);
    addClosure(importsOf(id, ctx), ctx, importsOf, found);
  }
  return found;
}
const THREE = /[\\/]node_modules[\\/](three|camera-controls|three-)/;
const LIBRARY = /[\\/]node_modules[\\/]/;

/**
 * Sorts what the app imports statically: what the lessons import too, so that their pages need nothing else of the app; libraries,
 * which change seldom, with the modules of ours that replace parts of them; what the embedded front imports too; the rest. No
 * group imports one after it, because scripts that import each other would begin in the wrong order.
 */
function sortedStart({ app, embed, lesson }, ctx) {
  const all = addClosure([app], ctx);
  const matching = (pattern) =>
    addClosure(
      [...all].filter((id) => pattern.test(id)),
      ctx,
    );
  return {
    all,
    groups: {
      lesson: addClosure([lesson], ctx, allImports),
      three: matching(THREE),
      libraries: matching(LIBRARY),
      shared: addClosure([embed], ctx),
      app: all,
    },
  };
}

/** Returns the groups of the bundler. `app`, `embed` and `lesson`: the first modules of the app, the embedded front and lessons. */
export function startGroups(first) {
  const { app } = first;
  let start;
  const name = (id, ctx) => {
    start ??= sortedStart(first, ctx);
    // The boot script needs helpers of the bundler, and nothing else. The first module of the app starts it: what other pages load
    // must not bring it along.
    if (!start.all.has(id) || id === app || id.includes("preload-helper")) return null;
    if (/\.css(\?|$)/.test(id)) return "styles";
    return Object.keys(start.groups).find((group) => start.groups[group].has(id)) ?? null;
  };
  return [{ debugName: "start", name, includeDependenciesRecursively: false }];
}

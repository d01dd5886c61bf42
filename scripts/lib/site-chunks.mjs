// The scripts that every visit needs, in few files: each file is a request, and small ones compress badly.
import path from "node:path";

/** Files of the package that only hand on what others export, by the name under which they are imported. */
const PACKAGE = /^tetrafront(?:\/(\w+))?$/;
const HANDED_ON = /[\\/]wasm[\\/]dist[\\/]\w+\.js$/;

/** Imports and exports with names: `import a, { b as c } from "d"`. */
const NAMED = /\b(?:import|export)\s*(?:[\w$]+\s*,\s*)?\{([^}]*)\}\s*from\s*["']([^"']+)["']/g;

/** Returns the names of each imported or exported list, as the other module has them. */
function namedIn(code) {
  return [...code.matchAll(NAMED)].map(([, list, from]) => ({
    names: list
      .split(",")
      .map((one) => one.trim().split(/\s+as\s+/)[0])
      .filter((one) => one !== ""),
    from,
  }));
}

/** Returns the module in which a file of the package has each name that it hands on. */
function ownersIn(id, ctx) {
  const owners = new Map();
  for (const { names, from } of namedIn(ctx.getModuleInfo(id)?.code ?? ""))
    for (const name of names) owners.set(name, path.resolve(path.dirname(id), from));
  return owners;
}

/**
 * Returns what a module imports statically. Of the files of the package that hand on, these are only the modules of the names that it
 * imports: the bundler leaves out the others, unless something else needs them, for example a reader of files when the first is read.
 */
function importedBy(id, ctx) {
  const { importedIds = [], code } = ctx.getModuleInfo(id) ?? {};
  const direct = importedIds.filter((imported) => !HANDED_ON.test(imported));
  if (direct.length === importedIds.length) return direct;
  const named = namedIn(code ?? "").filter(({ from }) => PACKAGE.test(from));
  const owned = named.flatMap(({ names, from }) => {
    const file = `${PACKAGE.exec(from)?.[1] ?? "index"}.js`;
    const barrel = importedIds.find(
      (imported) => HANDED_ON.test(imported) && path.basename(imported) === file,
    );
    const owners = barrel === undefined ? new Map() : ownersIn(barrel, ctx);
    return names.map((name) => {
      const owner = owners.get(name);
      if (owner === undefined) throw new Error(`${id} imports ${name} of ${from}, which nothing hands on`);
      return owner;
    });
  });
  return [...direct, ...owned];
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

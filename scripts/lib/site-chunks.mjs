// The scripts that every visit needs, in few files: each file is a request, and small ones compress badly.

const staticImports = (info) => info?.importedIds ?? [];
const allImports = (info) => [...staticImports(info), ...(info?.dynamicallyImportedIds ?? [])];

/** Adds modules and all that they import. */
function addClosure(ids, ctx, importsOf = staticImports, found = new Set()) {
  for (const id of ids) {
    if (found.has(id)) continue;
    found.add(id);
    addClosure(importsOf(ctx.getModuleInfo(id)), ctx, importsOf, found);
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

// The page of the built site shows a static shell at once, and loads the app behind it (web/boot.ts).

/** Returns the chunk and all that it imports statically. */
function closureOf(chunk, bundle, found = new Set()) {
  if (chunk?.type !== "chunk" || found.has(chunk)) return found;
  found.add(chunk);
  for (const name of chunk.imports) closureOf(bundle[name], bundle, found);
  return found;
}

/** Tags that fetch the app in parallel with its boot script. `data-bytes`: the shell shows how much has arrived. */
function tagsFor(entry, bundle) {
  const own = closureOf(entry, bundle);
  const chunks = new Set();
  for (const name of entry.dynamicImports) closureOf(bundle[name], bundle, chunks);
  const styles = [...chunks].flatMap((chunk) => [...(chunk.viteMetadata?.importedCss ?? [])]);
  const scripts = [...chunks].filter((chunk) => !own.has(chunk));
  const link = (attributes) => ({
    tag: "link",
    attrs: { crossorigin: true, ...attributes },
    injectTo: "head",
  });
  return [
    ...[...new Set(styles)].map((name) => link({ rel: "preload", as: "style", href: `./${name}` })),
    ...scripts.map(({ fileName, code }) =>
      link({ rel: "modulepreload", href: `./${fileName}`, "data-bytes": String(code.length) }),
    ),
  ];
}

/** Without it, the browser would find the scripts of the app only when the boot script has run. */
export function preloadedApp() {
  return {
    name: "tetrafront:preloaded-app",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler(_html, { path, bundle, chunk }) {
        if (!bundle || !chunk || path !== "/index.html") return [];
        return tagsFor(chunk, bundle);
      },
    },
  };
}

import react from "@vitejs/plugin-react";
import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";

/** Isolated pages may share memory with their workers; the app works without it too. */
const isolation = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
  "Cross-Origin-Resource-Policy": "same-origin",
};

const inRoot = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

/** The engine imports this module of Node only in Node, never in a browser. */
function withoutNodeModules(): Plugin {
  const name = "\0node-only";
  return {
    name: "tetrafront:without-node-modules",
    enforce: "pre",
    resolveId: (source) => (source === "module" ? name : null),
    load: (id) => (id === name ? "export const createRequire = undefined;" : null),
  };
}

/** Gives the view cube's library a clock that does not warn. */
function withOwnClock(): Plugin {
  return {
    name: "tetrafront:own-clock",
    transform: (code, id) => {
      const clock = /\bClock as (\w+),\s*/.exec(code);
      if (!id.includes("three-viewport-gizmo") || !clock) return null;
      const file = JSON.stringify(inRoot("./viewer/cube-clock.ts"));
      const own = `import { Clock as ${clock[1] ?? "Clock"} } from ${file};\n`;
      return { code: own + code.replace(clock[0], ""), map: null };
    },
  };
}

export default defineConfig({
  root: inRoot("."),
  publicDir: inRoot("../public"),
  // Relative addresses: the built site works from any folder of any host.
  base: "./",
  plugins: [react(), withoutNodeModules(), withOwnClock()],
  worker: { format: "es", plugins: () => [withoutNodeModules()] },
  server: { headers: isolation },
  preview: { headers: isolation },
  build: {
    target: "es2023",
    chunkSizeWarningLimit: 1500,
    sourcemap: true,
    rolldownOptions: { input: [inRoot("./index.html"), inRoot("./embed.html")] },
  },
});

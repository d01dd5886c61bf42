import react from "@vitejs/plugin-react";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { startGroups } from "../scripts/lib/site-chunks.mjs";
import { compressedAnswers } from "../scripts/lib/compressed-answers.mjs";
import { embindWithoutText } from "../scripts/lib/site-embind.mjs";
import { smallerFont } from "../scripts/lib/site-font.mjs";
import { thirdPartyNotices } from "../scripts/lib/site-notices.mjs";
import { offlineSite } from "../scripts/lib/site-offline.mjs";
import { smallerPackage } from "../scripts/lib/site-package.mjs";
import { contentSecurityPolicy } from "../scripts/lib/site-policy.mjs";
import { preloadedApp } from "../scripts/lib/site-preload.mjs";
import { smallerThree } from "../scripts/lib/site-three.mjs";
import { lessonTraces } from "../scripts/lib/site-traces.mjs";
import { lessonEntries, lessonSite } from "./teach/article/compiler/lesson-site.ts";

/** Isolated pages may share memory with their workers; the app works without it too. */
const isolation = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
  "Cross-Origin-Resource-Policy": "same-origin",
};

const inRoot = (path) => fileURLToPath(new URL(path, import.meta.url));

/** The engine imports this module of Node only in Node, never in a browser. */
function withoutNodeModules() {
  const name = "\0node-only";
  return {
    name: "tetrafront:without-node-modules",
    enforce: "pre",
    resolveId: (source) => (source === "module" ? name : null),
    load: (id) => (id === name ? "export const createRequire = undefined;" : null),
  };
}

const lessons = {
  root: inRoot("."),
  sources: inRoot("./lessons"),
  models: inRoot("../public/index.json"),
};
/** Every page of the site. */
const pages = [...["./index.html", "./embed.html"].map(inRoot), ...lessonEntries(lessons)];
const notices = thirdPartyNotices();

export default defineConfig({
  root: inRoot("."),
  publicDir: inRoot("../public"),
  // Relative addresses: the built site works from any folder of any host.
  base: "./",
  plugins: [
    lessonSite(lessons),
    react(),
    withoutNodeModules(),
    smallerPackage(),
    embindWithoutText(),
    smallerThree(),
    preloadedApp(),
    contentSecurityPolicy(),
    compressedAnswers(),
    notices,
    lessonTraces(),
    offlineSite({ source: inRoot("./service-worker.ts") }),
  ],
  worker: { format: "es", plugins: () => [withoutNodeModules(), smallerPackage(), notices.ofWorker()] },
  resolve: {
    alias: [
      // Locks the scroll bar behind a dialog by a style element, which the policy of the page forbids.
      { find: "react-style-singleton", replacement: inRoot("./ui/theme/style-singleton.ts") },
      await smallerFont(),
    ],
  },
  server: { headers: isolation },
  preview: { headers: isolation },
  build: {
    target: "es2023",
    // The policy of the page permits no fonts and scripts in data: addresses.
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1500,
    // All browsers of the target know the links.
    modulePreload: { polyfill: false },
    sourcemap: true,
    rolldownOptions: {
      input: pages,
      output: {
        codeSplitting: {
          groups: startGroups({
            app: inRoot("./main.tsx"),
            embed: inRoot("./teach/embed/start-embed.tsx"),
            lesson: inRoot("./teach/article/runtime/start-lesson.ts"),
          }),
        },
      },
    },
  },
});

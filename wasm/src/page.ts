/**
 * All of the package in one file, for pages without a bundler.
 *
 *     import { createMesher } from "https://…/node_modules/tetrafront/dist/page/tetrafront.js";
 */
export * from "./index.js";
export * from "./project.js";
export * from "./trace.js";

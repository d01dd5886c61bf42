import { fileURLToPath } from "node:url";
import path from "node:path";

/** Absolute paths of the repository's folders. */
export const root = path.resolve(fileURLToPath(new URL("../..", import.meta.url)));
export const inRoot = (...parts) => path.join(root, ...parts);

export const toolchain = inRoot(".toolchain");
export const glmFolder = path.join(toolchain, "glm");
/** The build folder of each configure preset in CMakePresets.json. */
export const buildFolders = {
  release: inRoot("build", "release"),
  wasm: inRoot("build", "wasm"),
  fuzz: inRoot("build", "fuzz"),
};
export const reports = inRoot("build", "reports");

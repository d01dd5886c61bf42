import { fileURLToPath } from "node:url";
import path from "node:path";

/** Absolute folders of the repository that the scripts share. */
export const root = path.resolve(fileURLToPath(new URL("../..", import.meta.url)));
export const inRoot = (...parts) => path.join(root, ...parts);

export const toolchain = inRoot(".toolchain");
export const glmFolder = path.join(toolchain, "glm");
export const buildFolders = {
  native: inRoot("build", "native"),
  asan: inRoot("build", "asan"),
  wasm: inRoot("build", "wasm"),
  fuzz: inRoot("build", "fuzz"),
};
export const reports = inRoot("build", "reports");

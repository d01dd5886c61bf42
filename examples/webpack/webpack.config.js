import path from "node:path";
import { fileURLToPath } from "node:url";

const folder = path.dirname(fileURLToPath(import.meta.url));

// No loaders are needed: webpack 5 finds the worker and the engine by `new URL(…, import.meta.url)`.
export default {
  mode: "production",
  context: folder,
  entry: "./main.js",
  output: { path: path.join(folder, "dist"), filename: "main.js" },
  // Raise the limit of webpack's size warning: the engine has 0.9 MB, its tools 1.5 MB, and each is fetched once.
  performance: { maxAssetSize: 1_600_000 },
};

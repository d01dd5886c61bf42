export default {
  base: "./",
  build: { target: "es2022" },
  worker: { format: "es" },
  // The development server's pre-bundling would lose the worker's file.
  optimizeDeps: { exclude: ["tetrafront"] },
};

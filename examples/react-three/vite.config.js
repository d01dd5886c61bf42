export default {
  base: "./",
  build: { target: "es2022" },
  worker: { format: "es" },
  // Do not pre-bundle the package: Vite's development server would not find the worker's file.
  optimizeDeps: { exclude: ["tetrafront"] },
};

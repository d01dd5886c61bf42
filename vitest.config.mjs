import { defineConfig } from "vitest/config";

/** Unit tests run in Node and load the compiled engine as users do. */
export default defineConfig({
  test: {
    include: ["tests/unit/**/*.test.{ts,tsx}"],
    environment: "node",
    // Meshing real models takes seconds on a small machine.
    testTimeout: 60_000,
    hookTimeout: 60_000,
    // Each worker holds an engine of its own.
    maxWorkers: 2,
  },
});

import { defineConfig } from "vitest/config";
import { pythonProgram } from "./scripts/lib/python.mjs";

/** Unit tests run in Node and load the compiled engine as users do. */
export default defineConfig({
  test: {
    include: ["tests/unit/**/*.test.{ts,tsx}"],
    environment: "node",
    env: { TETRAFRONT_PYTHON: pythonProgram() },
    // Only a hang takes so long, also on a machine that is small and busy. Longer limits would hide which test hangs: the tests
    // after it in its file wait for the same engine, each up to the limit.
    testTimeout: 180_000,
    hookTimeout: 180_000,
    // Each worker holds an engine of its own.
    maxWorkers: 2,
  },
});

// npm run clean: removes all build results; keeps node_modules and .toolchain.
import { rmSync } from "node:fs";
import { inRoot } from "./lib/paths.mjs";

for (const folder of [
  "build",
  "wasm/dist",
  "wasm/THIRD-PARTY-NOTICES.txt",
  "wasm/src/generated",
  "web/dist",
  "test-results",
  "playwright-report",
]) {
  rmSync(inRoot(folder), { recursive: true, force: true });
}

/**
 * npm run schema: writes docs/project.schema.json, the JSON Schema of project files. Run it after you change the schema
 * or the types of lines and patches. The package contains the same file.
 */
import { copyFileSync } from "node:fs";
import { build } from "./build.mjs";
import { inRoot } from "./lib/paths.mjs";
import { main } from "./lib/run.mjs";
import { setup } from "./setup.mjs";

await main(async () => {
  await build(["wasm", "package"], await setup([]));
  copyFileSync(inRoot("wasm", "dist", "project.schema.json"), inRoot("docs", "project.schema.json"));
});

// npm start: sets up, builds and serves the site.
import { build } from "./build.mjs";
import { main } from "./lib/run.mjs";
import { preview } from "./preview.mjs";
import { setup } from "./setup.mjs";

await main(async () => {
  await build(["wasm", "package", "site"], await setup([]));
  await preview();
});

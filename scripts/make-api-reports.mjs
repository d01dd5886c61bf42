/**
 * npm run api: writes docs/api, what each entry of the package promises. Run it after you change the public face, and say why in
 * the message.
 */
import { storeApiReports } from "./lib/api-report.mjs";
import { build } from "./build.mjs";
import { main } from "./lib/run.mjs";
import { setup } from "./setup.mjs";

await main(async () => {
  await build(["wasm", "package"], await setup([]));
  storeApiReports();
});

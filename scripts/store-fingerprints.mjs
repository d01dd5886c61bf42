/**
 * npm run fingerprints: stores the fingerprints of the meshes of all models of the gallery, of all bodies of the regression
 * tests and of the polygons filled in the plane in tests/fingerprints. Run it after a change that changes meshes for the better, and say in its message why they differ.
 */
import { rmSync } from "node:fs";
import path from "node:path";
import { build } from "./build.mjs";
import { buildFolders, inRoot } from "./lib/paths.mjs";
import { main, must } from "./lib/run.mjs";
import { setup } from "./setup.mjs";

await main(async () => {
  await build(["native", "wasm", "package"], await setup([]));
  rmSync(inRoot("tests", "fingerprints", "bodies.txt"), { force: true });
  await must(
    path.join(buildFolders.release, "tetrafront_tests"),
    ["--gtest_brief=1", "--gtest_filter=*/Regression*:PlaneFill.Fingerprints"],
    {
      env: { TETRAFRONT_STORE_FINGERPRINTS: "1" },
    },
  );
  await must(inRoot("node_modules", ".bin", "vitest"), [
    "run",
    "tests/unit/gallery/gallery.test.ts",
    "--update",
  ]);
});

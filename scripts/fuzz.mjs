// npm run fuzz [COUNT]: the seeded fuzz of surfaces for as many ruins as one likes (default 20 000).
import { inRoot } from "./lib/paths.mjs";
import { main, must } from "./lib/run.mjs";

await main(async () => {
  const env = { TETRAFRONT_FUZZ: process.argv[2] ?? "20000" };
  const args = ["run", "tests/unit/package/surface-fuzz.test.ts", "--testTimeout=0"];
  await must(inRoot("node_modules", ".bin", "vitest"), args, { env });
});

#!/usr/bin/env node
import { existsSync } from "node:fs";

const cli = new URL("../dist/cli/main.js", import.meta.url);
if (existsSync(cli)) {
  const { main } = await import(cli);
  process.exitCode = await main(process.argv.slice(2));
} else {
  process.stderr.write("tetrafront: error: this copy is not built yet. Run: npm run build\n");
  process.exitCode = 1;
}

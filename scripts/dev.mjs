// npm run dev: builds the engine and the package, then serves the sources of web/ with Vite's development server.
import { build } from "./build.mjs";
import { inRoot } from "./lib/paths.mjs";
import { main } from "./lib/run.mjs";
import { setup } from "./setup.mjs";

await main(async () => {
  await build(["wasm", "package"], await setup([]));
  const { createServer } = await import("vite");
  const port = process.env.PORT ? { port: Number(process.env.PORT) } : {};
  const server = await createServer({ root: inRoot("web"), server: port });
  await server.listen();
  server.printUrls();
});

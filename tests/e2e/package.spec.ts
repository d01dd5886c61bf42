/**
 * Tests the packed package in a browser: on a plain page, bundled by Vite, webpack and esbuild, and with React and
 * three.js.
 */
import { execFileSync } from "node:child_process";
import {
  copyFileSync,
  createReadStream,
  existsSync,
  mkdirSync,
  readFileSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

import { expect, test, type Page } from "@playwright/test";
import webpack, { type Configuration, type StatsCompilation } from "webpack";

import { freshInstall, type FreshInstall } from "../support/fresh-install.js";
import { storedPlanes } from "../support/planes.js";
import { boxSolid, stepFile } from "../support/step-files.js";
import { sphereSurface } from "../support/surfaces.js";

const bin = (name: string) => fileURLToPath(new URL(`../../node_modules/.bin/${name}`, import.meta.url));
const STRICT =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'";
const TYPES: Readonly<Record<string, string>> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".mjs": "text/javascript",
  ".wasm": "application/wasm",
};

let fresh: FreshInstall;
let server: Server | undefined;
test.beforeAll(() => {
  fresh = freshInstall(["react", "react-dom", "scheduler", "three"]);
});
test.afterAll(() => fresh.dispose());
test.afterEach(() => server?.close());

/** Names of the files that pages asked for. */
const requested: string[] = [];

/**
 * Serves a folder, except the files `missing`, with this Content-Security-Policy; resolves with the address of the
 * page.
 */
async function served(
  folder: string,
  policy: string,
  missing: ReadonlySet<string> = new Set(),
): Promise<string> {
  const started = createServer((request, response) => {
    const name = new URL(request.url ?? "/", "http://localhost").pathname;
    const file = path.join(folder, name === "/" ? "index.html" : name);
    requested.push(path.basename(file));
    const isThere = existsSync(file) && statSync(file).isFile() && !missing.has(path.basename(file));
    if (!isThere) return void response.writeHead(404).end();
    const type = TYPES[path.extname(file)] ?? "application/octet-stream";
    response.writeHead(200, {
      "Content-Type": type,
      "Content-Security-Policy": policy,
      "Access-Control-Allow-Origin": "*",
    });
    createReadStream(file).pipe(response);
  });
  server = started;
  await new Promise<void>((resolve) => started.listen(0, "127.0.0.1", resolve));
  return `http://127.0.0.1:${(started.address() as AddressInfo).port}/`;
}

async function expectBoxMeshed(page: Page, address: string): Promise<void> {
  const problems: string[] = [];
  page.on("console", (message) => {
    if (message.type() === "error" && !message.text().includes("favicon")) problems.push(message.text());
  });
  page.on("pageerror", (error) => problems.push(error.message));
  const engines: string[] = [];
  page.context().on("request", (request) => {
    if (request.url().includes(".wasm")) engines.push(request.url());
  });
  await page.goto(address);
  const button = page.getByRole("button", { name: "Mesh" });
  await expect(button, problems.join("\n")).toBeEnabled();
  expect(engines).toHaveLength(1);
  await button.click();
  await expect(page.getByRole("status")).toHaveText(/^done: \d+ tetrahedra of volume 1\.000000$/);
  expect(problems.filter((text) => !text.includes("404"))).toEqual([]);
  // Refining the surface needs the tools.
  expect(engines).toHaveLength(2);
  expect(new Set(engines).size).toBe(2);
}

test("the package works on a plain page without a bundler, under a strict Content-Security-Policy", async ({
  page,
}) => {
  await expectBoxMeshed(page, await served(fresh.example("page"), STRICT));
});

test("a plain page reads a CAD file by the library beside the package; without it, the error says what to do", async ({
  page,
}) => {
  const folder = path.join(fresh.folder, "page");
  if (!existsSync(folder)) fresh.example("page");
  writeFileSync(path.join(folder, "box.step"), stepFile([boxSolid("box", [0, 0, 0], [1, 1, 1])]));
  writeFileSync(path.join(folder, "cad.html"), '<script type="module" src="cad.js"></script>');
  writeFileSync(path.join(folder, "cad.js"), READ_CAD_FILE);
  const policy = STRICT.replace("'wasm-unsafe-eval'", "'wasm-unsafe-eval' 'unsafe-eval'");
  const missing = new Set<string>(["occt-import-js.wasm", "replicad_single.wasm"]);
  await page.goto(`${await served(folder, policy, missing)}cad.html`);
  await expect(page).toHaveTitle(/^missing-library .* setCadLibrary\(\)/);
  missing.clear();
  await page.reload();
  await expect(page).toHaveTitle("6 patches");
});

/** Reads a CAD file that is served beside the page. */
const READ_CAD_FILE = `import { readSurface } from "./node_modules/tetrafront/dist/page/tetrafront.js";
const read = await readSurface((await fetch("box.step")).body, { fileName: "box.step" });
document.title = read.success
  ? read.value.patches.length + " patches"
  : read.errors[0].code + " " + read.errors[0].remedy;`;

test("each module is fetched once for any number of meshers and replaced workers", async ({ page }) => {
  const folder = path.join(fresh.folder, "page");
  if (!existsSync(folder)) fresh.example("page");
  writeFileSync(path.join(folder, "many.html"), '<script type="module" src="many.js"></script>');
  writeFileSync(path.join(folder, "many.js"), MANY_MESHERS);
  const fetched: string[] = [];
  page.context().on("request", (request) => fetched.push(path.basename(request.url())));
  await page.goto(`${await served(folder, STRICT)}many.html`);
  await expect(page).toHaveTitle("invalid-input cancelled true true true");
  const modules = fetched.filter((name) => name.endsWith(".wasm"));
  expect(modules.sort()).toEqual(["engine.wasm", "tools.wasm"]);
});

for (const [file, reason] of [
  ["tools.wasm", /http:\S+tools\.wasm is .* status 404\. Serve/],
  ["tools.js", /http:\S+tools\.js\. Serve/],
] as const) {
  test(`filling a surface does not fetch ${file}; inspecting it does, again after a failure`, async ({
    page,
  }) => {
    const folder = path.join(fresh.folder, "page");
    if (!existsSync(folder)) fresh.example("page");
    writeFileSync(path.join(folder, "inspect.html"), '<script type="module" src="inspect.js"></script>');
    writeFileSync(path.join(folder, "inspect.js"), FILL_THEN_INSPECT);
    const missing = new Set<string>([file]);
    const fetched: string[] = [];
    page.context().on("request", (request) => fetched.push(path.basename(request.url())));
    await page.goto(`${await served(folder, STRICT, missing)}inspect.html`);
    await expect(page).toHaveTitle("done");
    expect(fetched).not.toContain(file);
    await page.evaluate("inspect()");
    await expect(page).toHaveTitle(/^engine-not-loaded: The engine cannot be loaded: /);
    expect(await page.title()).toMatch(reason);
    missing.clear();
    await page.evaluate("inspect()");
    await expect(page).toHaveTitle("closed");
    await page.evaluate("fill()");
    await expect(page).toHaveTitle("done");
  });
}

test("a page fills polygons in its own thread, without the engine, as natively", async ({ page }) => {
  const folder = path.join(fresh.folder, "page");
  if (!existsSync(folder)) fresh.example("page");
  const [plane] = storedPlanes();
  if (!plane) throw new Error("no polygon is stored");
  const given = { loops: plane.loops.map((loop) => [...loop]), sizes: plane.sizes, options: plane.options };
  writeFileSync(path.join(folder, "plane.html"), '<script type="module" src="plane.js"></script>');
  writeFileSync(path.join(folder, "plane.js"), FILL_PLANE.replace("GIVEN", JSON.stringify(given)));
  const missing = new Set<string>(["plane.wasm"]);
  const fetched: string[] = [];
  page.context().on("request", (request) => fetched.push(path.basename(request.url())));
  await page.goto(`${await served(folder, STRICT, missing)}plane.html`);
  await expect(page).toHaveTitle(/^engine-not-loaded: .*plane\.wasm is .* status 404/);
  missing.clear();
  await page.evaluate("fill()");
  await expect(page).toHaveTitle(plane.fingerprint);
  expect(fetched.filter((name) => name.endsWith(".wasm"))).toEqual(["plane.wasm", "plane.wasm"]);
  expect(page.workers()).toHaveLength(0);
});

/** Fills a polygon; `fill()` tries again. */
const FILL_PLANE = `import { fillPlane } from "./node_modules/tetrafront/dist/page/tetrafront.js";
const { loops, sizes, options } = GIVEN;
globalThis.fill = () =>
  fillPlane(loops.map((loop) => Float64Array.from(loop)), sizes, options).then(
    (filled) => { document.title = filled.success ? filled.fingerprint : filled.message; },
    ({ code, message }) => { document.title = code + ": " + message; },
  );
await fill();`;

/** Fills a tetrahedron; `inspect()` and `fill()` do more with the same mesher. */
const FILL_THEN_INSPECT = `import { createMesher } from "./node_modules/tetrafront/dist/page/tetrafront.js";
const points = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
const surface = { points, triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3) };
const mesher = await createMesher();
const show = (text) => { document.title = text; };
globalThis.fill = () => mesher.fillSurface(surface).then(({ report }) => show(report.status));
globalThis.inspect = () => mesher.inspectSurface(surface).then(
  ({ isClosed }) => show(isClosed ? "closed" : "open"),
  ({ code, message }) => show(code + ": " + message),
);
await fill();`;

/** Starts two meshers together and a third one later, whose worker is then replaced during a call. */
const MANY_MESHERS = `import { createMesher } from "./node_modules/tetrafront/dist/page/tetrafront.js";
const [one, two] = await Promise.all([createMesher(), createMesher()]);
const three = await createMesher();
const points = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
const tetrahedron = { points, triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3) };
const stop = new AbortController();
const mesh = { points, tetrahedra: Uint32Array.of(0, 1, 2, 3) };
const given = three.backgroundFromMesh(mesh, {}, { signal: stop.signal }).catch(({ code }) => code);
stop.abort();
const { report } = await three.fillSurface({ points, triangles: new Uint32Array(3) });
const answer = await given;
const inspected = await Promise.all([one, two, three].map((mesher) => mesher.inspectSurface(tetrahedron)));
document.title = [report.status, answer, ...inspected.map(({ isClosed }) => isClosed)].join(" ");`;

test.describe("createMesher rejects with the address, the reason and a remedy", () => {
  const FAILING = `import { createMesher } from "MODULE";
createMesher().catch(({ name, code, message }) => { document.title = [name, code, message].join(" | "); });`;
  for (const [what, missing, policy, message] of [
    [
      "the worker is missing",
      "worker.js",
      STRICT,
      /worker cannot be loaded: the browser could not load its script.* for http:\S+\.js\. Serve/,
    ],
    [
      "a script that the worker imports is missing",
      "engine.js",
      STRICT,
      /worker cannot be loaded: the browser could not load its script, or a script that it imports, .*Serve worker\.js .*and the scripts/,
    ],
    ["the engine is missing", "engine.wasm", STRICT, /loaded: http:\S+engine\.wasm is .* status 404\. Serve/],
    [
      "trusted types are required",
      "nothing",
      `${STRICT}; require-trusted-types-for 'script'`,
      /worker cannot be loaded: TypeError.*Serve/,
    ],
    [
      "the engine may not be compiled",
      "nothing",
      STRICT.replace("'wasm-unsafe-eval'", ""),
      /engine\.wasm: .*Serve/,
    ],
    [
      "the scripts come from another site",
      "nothing",
      `${STRICT} *`,
      /worker cannot be loaded: SecurityError.*Serve/,
    ],
  ] as const) {
    test(`if ${what}`, async ({ page }) => {
      const folder = path.join(fresh.folder, "page");
      if (!existsSync(folder)) fresh.example("page");
      writeFileSync(path.join(folder, "failing.html"), '<script type="module" src="failing.js"></script>');
      const open = policy.replace("script-src 'self'", "script-src 'self' http:");
      const address = await served(folder, open, new Set([missing]));
      const site = what.includes("another") ? address.replace("127.0.0.1", "localhost") : address;
      const module = `${site}node_modules/tetrafront/dist/page/tetrafront.js`;
      writeFileSync(path.join(folder, "failing.js"), FAILING.replace("MODULE", module));
      await page.goto(`${address}failing.html`);
      await expect(page).toHaveTitle(/^MesherError \| engine-not-loaded \| /);
      expect(await page.title()).toMatch(message);
      expect(await page.title()).not.toMatch(/undefined|ASSERTIONS/);
    });
  }
});

test("Vite bundles the package", async ({ page }) => {
  const folder = fresh.example("vite");
  execFileSync(process.execPath, [bin("vite"), "build", "--logLevel", "warn"], { cwd: folder });
  await expectBoxMeshed(page, await served(path.join(folder, "dist"), STRICT));
});

/** Fills a large sphere by the numbers of threads in the address, and states the fingerprints. */
const fillBySeveral = (module: string) => `import { createMesher } from "${module}";
const { points, triangles } = await (await fetch("sphere.json")).json();
const surface = { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
const mesher = await createMesher();
const made = [];
for (const threads of new URLSearchParams(location.search).get("threads").split(",").map(Number)) {
  const options = { optimization: "fast", interior: "front", threads };
  const { report } = await mesher.fillSurface(surface, options);
  made.push(report.status + report.threads + (report.tetrahedra > 60000 ? " large " : " small ") + report.fingerprint);
}
document.title = made.join(" ");`;

/** Saves the page that fills a sphere by several threads. `files`: folder of the sphere. */
function saveFilling(
  folder: string,
  name: string,
  { module, files = folder }: { readonly module: string; readonly files?: string },
): void {
  const { points, triangles } = sphereSurface(22);
  const sphere = JSON.stringify({ points: [...points], triangles: [...triangles] });
  writeFileSync(path.join(files, "sphere.json"), sphere);
  writeFileSync(path.join(folder, "many-threads.js"), fillBySeveral(module));
  writeFileSync(path.join(folder, name), '<script type="module" src="many-threads.js"></script>');
}

const SAME_MESH = /^done1 large ([0-9a-f]{16}) done2 large \1$/;

test("a second worker optimizes tiles of the same mesh: on a plain page, and in a bundle of Vite", async ({
  page,
}) => {
  test.slow();
  const isTileWorker = (name: string): boolean => name.startsWith("tile-worker");
  let byTwo = "";
  await test.step("on a plain page, a second worker optimizes tiles of the same mesh; without its script, the first does all", async () => {
    const folder = path.join(fresh.folder, "page");
    if (!existsSync(folder)) fresh.example("page");
    const module = "./node_modules/tetrafront/dist/page/tetrafront.js";
    saveFilling(folder, "many-threads.html", { module });
    const missing = new Set<string>();
    requested.splice(0);
    const address = `${await served(folder, STRICT, missing)}many-threads.html`;
    await page.goto(`${address}?threads=1,2`);
    await expect(page).toHaveTitle(SAME_MESH, { timeout: 60_000 });
    expect(requested.filter(isTileWorker)).toHaveLength(1);
    byTwo = (await page.title()).replace(/^.* done2/, "done2");
    missing.add("tile-worker.js");
    await page.goto(`${address}?threads=2`);
    await expect(page).toHaveTitle(byTwo, { timeout: 60_000 });
    server?.close();
  });
  await test.step("in a bundle of Vite, a second worker optimizes tiles of the same mesh", async () => {
    const folder = path.join(fresh.folder, "vite-threads");
    mkdirSync(path.join(folder, "public"), { recursive: true });
    const config = fileURLToPath(new URL("../../examples/vite/vite.config.js", import.meta.url));
    copyFileSync(config, path.join(folder, "vite.config.js"));
    saveFilling(folder, "index.html", { module: "tetrafront", files: path.join(folder, "public") });
    execFileSync(process.execPath, [bin("vite"), "build", "--logLevel", "warn"], { cwd: folder });
    requested.splice(0);
    await page.goto(`${await served(path.join(folder, "dist"), STRICT)}?threads=2`);
    await expect(page).toHaveTitle(byTwo, { timeout: 60_000 });
    expect(requested.filter(isTileWorker)).toHaveLength(1);
  });
});

test("webpack bundles the package", async ({ page }) => {
  test.slow();
  const folder = fresh.example("webpack");
  const file = pathToFileURL(path.join(folder, "webpack.config.js")).href;
  const config = ((await import(file)) as { readonly default: Configuration }).default;
  const bundled = await new Promise<StatsCompilation | undefined>((resolve, reject) => {
    webpack(config, (failure, stats) => {
      if (failure !== null) reject(failure);
      else resolve(stats?.toJson({ all: false, errors: true, warnings: true }));
    });
  });
  expect(bundled).toMatchObject({ errors: [], warnings: [] });
  await expectBoxMeshed(page, await served(folder, STRICT));
});

test("esbuild bundles the package, with the worker as a separate entry and the modules copied", async ({
  page,
}) => {
  const folder = path.join(fresh.folder, "vite");
  const target = path.join(fresh.folder, "bundled");
  if (!existsSync(folder)) fresh.example("vite");
  const dist = path.join(fresh.folder, "node_modules", "tetrafront", "dist");
  const workers = ["worker.js", "tile-worker.js"].map((name) => path.join(dist, "engine", name));
  const entries = [path.join(folder, "main.js"), ...workers];
  const options = ["--bundle", "--format=esm", "--splitting", "--entry-names=[name]", `--outdir=${target}`];
  execFileSync(bin("esbuild"), [...entries, ...options, "--log-level=warning"], { cwd: fresh.folder });
  for (const name of ["engine.wasm", "tools.wasm"]) {
    copyFileSync(path.join(dist, "engine", name), path.join(target, name));
  }
  writeFileSync(path.join(target, "index.html"), readFileSync(path.join(folder, "index.html")));
  await expectBoxMeshed(page, await served(target, STRICT));
});

test("the example with React and three.js shows the elements inside", async ({ page }) => {
  const folder = fresh.example("react-three");
  execFileSync(process.execPath, [bin("vite"), "build", "--logLevel", "warn"], { cwd: folder });
  const styled = `${STRICT}; style-src 'unsafe-inline'; img-src 'self' blob: data:`;
  await page.goto(await served(path.join(folder, "dist"), styled));
  await page.getByRole("button", { name: "Mesh" }).click();
  await expect(page.getByRole("status")).toHaveText(/^done: \d+ tetrahedra$/);
  await expect(page.getByRole("img")).toHaveAttribute("data-faces", /^\d{3,}$/);
});

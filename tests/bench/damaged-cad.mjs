// Reads damaged STEP, IGES and BREP files, COUNT of each (TETRAFRONT_FILES, default 1000), and prints how they end. Each ends
// as a surface, or as an error; a file that keeps OpenCascade busy for more than SECONDS is given up. Exits with 1 if a surface
// is invalid or a failure has no message.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { Worker } from "node:worker_threads";
import { inRoot } from "../../scripts/lib/paths.mjs";
import { surfaceOfShapes } from "../../wasm/dist/formats/shape-surface.js";
import { moduleServer } from "./support/modules.mjs";

const COUNT = Number(process.env.TETRAFRONT_FILES ?? 1000);
const SECONDS = 20;

const server = await moduleServer();
const { mutated, randomSource } = await server.ssrLoadModule("/tests/support/random.ts");
const { drilledSolid, stepFile } = await server.ssrLoadModule("/tests/support/step-files.ts");
await server.close();

const sample = inRoot(
  "node_modules",
  "occt-import-js",
  "test",
  "testfiles",
  "cube-10x10mm",
  "Cube 10x10.igs",
);
const FILES = {
  step: stepFile([drilledSolid("plate", [0, 0, 0], [20, 10, 8], [8, 5], 3)]),
  iges: readFileSync(sample),
  brep: readFileSync(inRoot("tests", "fixtures", "plate.brep")),
};

const binary = createRequire(import.meta.url)
  .resolve("occt-import-js")
  .replace(/\.js$/, ".wasm");
const library = await WebAssembly.compile(readFileSync(binary));

let worker;

/** Returns the reply of a worker, or that it was given up. */
function ask(request) {
  worker ??= new Worker(new URL("support/cad-reader.mjs", import.meta.url), { workerData: library });
  const asked = worker;
  return new Promise((resolve) => {
    const end = (reply, isAlive) => {
      clearTimeout(timer);
      asked.removeAllListeners("message").removeAllListeners("error");
      if (!isAlive) {
        worker = undefined;
        void asked.terminate();
      }
      resolve(reply);
    };
    const timer = setTimeout(() => end({ kind: "timed-out" }, false), 1000 * SECONDS);
    // As in the package, an instance that has failed is not used again.
    asked.once("message", (reply) => end(reply, reply.kind === "read" && reply.shapes.length > 0));
    asked.once("error", ({ message }) => end({ kind: "failed", message }, false));
    asked.postMessage(request);
  });
}

function finished(steps) {
  for (;;) {
    const { done, value } = steps.next();
    if (done) return value;
  }
}

/** Returns what the package says of a reply. */
function outcomeOf(reply) {
  if (reply.kind !== "read") {
    const isTold = !["failed", "out-of-memory"].includes(reply.kind) || reply.message?.length > 0;
    return isTold ? reply.kind : "without a message";
  }
  const shapes = reply.shapes.filter(({ triangles }) => triangles.length > 0);
  if (shapes.length === 0) return "empty";
  const { points, triangles, trianglePatch, patches } = finished(surfaceOfShapes(shapes));
  const isValid =
    points.every(Number.isFinite) &&
    triangles.every((node) => 3 * node < points.length) &&
    trianglePatch.every((patch) => patch < patches.length);
  return isValid ? "read" : "invalid";
}

const KINDS = { read: "surface", empty: "no solids and no faces", rejected: "cannot be read", failed: "OpenCascade fails", "out-of-memory": "out of memory", "timed-out": `busy for ${SECONDS} s` }; // prettier-ignore
console.log(`| format | files | ${Object.values(KINDS).join(" | ")} | slowest surface or error, s |`);
console.log(`| --- | ${"---: | ".repeat(Object.keys(KINDS).length + 2)}`.trim());
for (const [format, file] of Object.entries(FILES)) {
  const counts = {};
  let slowest = 0;
  const whole = outcomeOf(await ask({ format, bytes: file }));
  if (whole !== "read") throw new Error(`The ${format} file is not read before it is damaged: ${whole}`);
  for (let seed = 1; seed <= COUNT; ++seed) {
    const began = performance.now();
    const reply = await ask({ format, bytes: mutated(file, randomSource(seed)) });
    const outcome = outcomeOf(reply);
    if (outcome !== "timed-out") slowest = Math.max(slowest, performance.now() - began);
    counts[outcome] = (counts[outcome] ?? 0) + 1;
    if (KINDS[outcome] === undefined) {
      console.error(`${format}, seed ${seed}: ${outcome}`);
      process.exitCode = 1;
    }
  }
  const cells = Object.keys(KINDS).map((kind) => counts[kind] ?? 0);
  console.log(
    `| ${format.toUpperCase()} | ${COUNT} | ${cells.join(" | ")} | ${(slowest / 1000).toFixed(1)} |`,
  );
}
await worker?.terminate();

// Runs our engine on a surface in a file, natively and as WebAssembly, each run in its own process. Seconds are
// processor time, the minimum of several runs: other work on the machine only adds time.
import { execFileSync } from "node:child_process";
import path from "node:path";
import { fileURLToPath } from "node:url";

const RUNS = Number(process.env.TETRAFRONT_BENCH_RUNS ?? 5);

export const fill = process.env.TETRAFRONT_FILL;
if (!fill) {
  console.error("Run this by `npm run bench`: it needs the native programs beside TETRAFRONT_FILL.");
  process.exit(2);
}
const frontClock = path.join(path.dirname(fill), "front_clock");
const wasmFill = fileURLToPath(new URL("wasm-fill.mjs", import.meta.url));

/** Parses `name value` lines; values become numbers if possible. */
export function valuesOf(text) {
  const lines = text.trim().split("\n");
  const pairs = lines.map((line) => line.split(" "));
  return Object.fromEntries(
    pairs.map(([name, value]) => [name, name === "fingerprint" ? value : asNumber(value)]),
  );
}

function asNumber(text) {
  const number = Number(text);
  return Number.isNaN(number) ? text : number;
}

const run = (program, args, input) => valuesOf(execFileSync(program, args, { encoding: "utf8", input }));

/** Returns the values of the first run, with each time replaced by the minimum over all runs. */
function leastTimes(runs) {
  const least = { ...runs[0] };
  for (const name of Object.keys(least).filter((key) => key.toLowerCase().endsWith("seconds"))) {
    least[name] = Math.min(...runs.map((one) => one[name]));
  }
  return least;
}

/** `level`: optimization level; `interior`: what fills the deep inside. */
export function fillNatively(file, level, interior = "front") {
  const args = [file, `--optimization=${level}`, `--interior=${interior}`];
  return leastTimes(Array.from({ length: RUNS }, () => run(fill, args)));
}

/**
 * Measures warm runs. The first run of the process, in which V8 compiles, is reported separately as
 * `firstSeconds`.
 */
export function fillAsWebAssembly(file, level, interior = "front") {
  return run(process.execPath, [wasmFill, file, level, String(RUNS + 1), interior]);
}

/** Measures the front alone on a boundary. Without a grid, the sizes come from the boundary's own edges. */
export function clockFront(order, filters, { points, triangles }, grid = { nodes: [], tetrahedra: [] }) {
  const { nodes, tetrahedra } = grid;
  const positions = new Map(nodes.map(({ id }, position) => [id, position]));
  const counts = [points.length / 3, triangles.length / 3, nodes.length, tetrahedra.length];
  const gridNodes = nodes.flatMap(({ position, size }) => [...position, size]);
  const corners = tetrahedra.flat().map((id) => positions.get(id));
  const input = [counts, points, triangles, gridNodes, corners].map((list) => list.join(" ")).join("\n");
  return run(frontClock, [order, filters], input);
}

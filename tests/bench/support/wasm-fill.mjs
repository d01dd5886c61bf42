// Runs the WebAssembly engine on a closed surface in this thread: the counterpart of the native program `fill`,
// for the benchmarks.
//
//     node wasm-fill.mjs SURFACE.off LEVEL RUNS INTERIOR
//
// Fills the surface RUNS times, or more until V8 has had time to compile. LEVEL is the optimization level,
// INTERIOR what fills the deep inside. Prints `name value` lines with the results of the fastest run, in processor
// time; the minimum volume and optimization times of all runs; `firstSeconds` of the first run; and the size of the
// engine's memory after all runs.
import { readFileSync } from "node:fs";
import createEngine from "../../../wasm/dist/engine/engine.js";
import {
  ENGINE_STATUSES,
  INTERIORS,
  MESH_DEFAULTS,
  OPTIMIZATIONS,
  PHASES,
} from "../../../wasm/dist/generated/constants.js";

// The budget per call, as in wasm/src/engine/slices.ts.
const BUDGET = 256;
const WARM_SECONDS = 3;

function readOff(file) {
  const words = readFileSync(file, "ascii").split(/\s+/);
  const [points, triangles] = [Number(words[1]), Number(words[2])];
  const corners = 4 + 3 * points;
  return {
    points: Float64Array.from(words.slice(4, corners), Number),
    triangles: Uint32Array.from({ length: 3 * triangles }, (_, i) =>
      Number(words[corners + 4 * Math.floor(i / 3) + 1 + (i % 3)]),
    ),
  };
}

/** Returns the engine and its memory, which the engine's module does not expose. */
async function loadEngine() {
  const binary = readFileSync(new URL("../../../wasm/dist/engine/engine.wasm", import.meta.url));
  let memory;
  const engine = await createEngine({
    instantiateWasm(imports, receive) {
      void WebAssembly.instantiate(binary, imports).then(({ instance, module }) => {
        memory = Object.values(instance.exports).find((given) => given instanceof WebAssembly.Memory);
        receive(instance, module);
      });
      return {};
    },
  });
  return { engine, memory };
}

/**
 * Returns the processor time of all threads of this process; with a warm engine, the other threads are almost
 * idle.
 */
function processorSeconds() {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1e6;
}

function fill(engine, surface, optimization, interior) {
  const none = new Float64Array(0);
  const grid = {
    nodes: { position: none, size: none, stretching: none, direction: none },
    tetrahedra: new Uint32Array(0),
    sources: { type: new Uint8Array(0), points: none, size: none, distance: none, growth: none },
    coverageMargin: 0,
    secondStretchings: { stretching: none, direction: none },
  };
  const options = { ...MESH_DEFAULTS, order: 0, innerShells: 0, optimization, interior };
  const regions = { triangleRegions: new Uint32Array(0), maxVolumes: none };
  const run = engine.fillSurface(surface.points, surface.triangles, regions, grid, options);
  const seconds = Object.fromEntries(PHASES.map((phase) => [phase, 0]));
  let status = "running";
  for (let before = processorSeconds(); status === "running";) {
    const phase = PHASES[run.phase()];
    status = ENGINE_STATUSES[run.advance(BUDGET)];
    const after = processorSeconds();
    seconds[phase] += after - before;
    before = after;
  }
  const { tetrahedra } = run.progress();
  const fingerprint = run.fingerprint();
  const { minDihedral, maxDihedral, meanRadiusRatio } = run.quality();
  run.delete();
  const total = Object.values(seconds).reduce((sum, part) => sum + part);
  return { status, tetrahedra, fingerprint, minDihedral, maxDihedral, meanRadiusRatio, seconds, total };
}

const [file, level, runs, inside] = process.argv.slice(2);
const surface = readOff(file);
const { engine, memory } = await loadEngine();
const bytesBefore = memory.buffer.byteLength;
const all = [];
for (
  const began = processorSeconds();
  all.length < Number(runs) || processorSeconds() - began < WARM_SECONDS;
) {
  all.push(fill(engine, surface, OPTIMIZATIONS.indexOf(level), INTERIORS.indexOf(inside)));
}
const best = all.reduce((one, other) => (other.total < one.total ? other : one));
const lines = {
  status: best.status,
  tetrahedra: best.tetrahedra,
  seconds: best.total,
  firstSeconds: all[0].total,
  checkSeconds: best.seconds.check,
  volumeSeconds: Math.min(...all.map((run) => run.seconds.volume)),
  optimizeSeconds: Math.min(...all.map((run) => run.seconds.optimize)),
  verifySeconds: best.seconds.verify,
  initialBytes: bytesBefore,
  bytes: memory.buffer.byteLength,
  minDihedral: best.minDihedral,
  maxDihedral: best.maxDihedral,
  meanRadiusRatio: best.meanRadiusRatio,
  fingerprint: best.fingerprint,
};
for (const [name, value] of Object.entries(lines)) console.log(`${name} ${value}`);

// Prints the tables of docs/BENCHMARKS.md as Markdown: the front alone and with the optimizer, natively and as
// WebAssembly, from ten thousand to a million tetrahedra; growth of the time, memory and the share of the crossing
// test; and other meshers on the same triangles, if they are installed. Exits with 1 if native and WebAssembly
// results differ in a bit.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { arch, cpus, tmpdir } from "node:os";
import path from "node:path";
import { clockFront, fillAsWebAssembly, fillNatively } from "./support/engines.mjs";
import { geodesicSphere, toOff } from "./support/geodesic-sphere.mjs";
import { availablePeers, INSTALL, runPeer } from "./support/peers.mjs";

/** Subdivisions of the icosahedron's edges for about this many thousand tetrahedra. */
const SPHERES = { 10: 9, 100: 19, 300: 27, 1000: 41 };
const REFERENCE = 100; // the size at which other meshers are compared
const PEERS = {
  "netgen-front": "Netgen, front (`delaunay=False`)",
  "netgen-front-optimized": "the same, optimized",
  "netgen-default": "Netgen, default",
  "netgen-default-optimized": "the same, optimized",
  "gmsh-frontal": "Gmsh, frontal",
  "gmsh-delaunay": "Gmsh, Delaunay",
  "gmsh-delaunay-optimized": "the same, optimized",
  "gmsh-hxt": "Gmsh, HXT",
  "gmsh-hxt-optimized": "the same, optimized",
  tetgen: "TetGen, quality",
};

const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-bench-"));
const spheres = Object.entries(SPHERES).map(([thousands, divisions]) => {
  const surface = geodesicSphere(divisions);
  const file = path.join(folder, `sphere-${thousands}k.off`);
  writeFileSync(file, toOff(surface));
  return { thousands: Number(thousands), surface, file };
});

const table = (...rows) => {
  const [head, ...body] = rows;
  const rule = head.map((_, i) => (i === 0 ? "---" : "---:"));
  for (const row of [head, rule, ...body]) console.log(`| ${row.join(" | ")} |`);
  console.log("");
};
const count = (number) => number.toLocaleString("en-US").replaceAll(",", " ");
const perSecond = (tetrahedra, seconds) => count(1000 * Math.round(tetrahedra / seconds / 1000));
const seconds = (value) => value.toPrecision(3);
const degrees = (value) => `${value.toFixed(1)}°`;
const times = (value) => `${value.toPrecision(3)} ×`;

/** Returns the exponent of time ~ count^exponent between the smallest and the largest number of tetrahedra. */
function exponent(runs, secondsOf) {
  const [first, last] = [runs[0], runs[runs.length - 1]];
  return Math.log(secondsOf(last) / secondsOf(first)) / Math.log(last.tetrahedra / first.tetrahedra);
}

const front = (run) => run.volumeSeconds;
const optimized = (run) => run.volumeSeconds + run.optimizeSeconds;

/** Measures our engine on one sphere, and compares native with WebAssembly. */
function runOurs({ thousands, file }) {
  const measured = (fill) => ({
    front: fill(file, "none"),
    optimized: fill(file, "default"),
    lattice: fill(file, "default", "lattice"),
  });
  const native = measured(fillNatively);
  const wasm = measured(fillAsWebAssembly);
  const isSame = ["front", "optimized", "lattice"].every(
    (kind) => native[kind].fingerprint === wasm[kind].fingerprint,
  );
  return { thousands, native, wasm, isSame };
}

function showSizes(runs) {
  console.log("## Tetrafront, from 10 k to a million tetrahedra\n");
  const rows = (kind, secondsOf) =>
    runs.map(({ native, wasm, isSame }) => [
      count(native[kind].tetrahedra),
      perSecond(native[kind].tetrahedra, secondsOf(native[kind])),
      perSecond(wasm[kind].tetrahedra, secondsOf(wasm[kind])),
      (secondsOf(native[kind]) / secondsOf(wasm[kind])).toFixed(2),
      seconds(native[kind].seconds),
      seconds(wasm[kind].seconds),
      // The peak is unknown for a small surface: reading it may need more memory than meshing it.
      native[kind].bytes > 0 ? Math.round(native[kind].bytes / native[kind].tetrahedra) : "–",
      // The initial memory of the WebAssembly engine suffices for small meshes.
      wasm[kind].bytes > wasm[kind].initialBytes ? Math.round(wasm[kind].bytes / wasm[kind].tetrahedra) : "–",
      isSame ? "yes" : "**no**",
    ]);
  const head = (what) => [
    `tetrahedra, ${what}`,
    "native, per second",
    "WebAssembly, per second",
    "of native",
    "whole run, native [s]",
    "WebAssembly [s]",
    "bytes per tetrahedron, native",
    "WebAssembly",
    "same mesh",
  ];
  table(head("front alone"), ...rows("front", front));
  table(head("front and optimizer"), ...rows("optimized", optimized));
  table(head("lattice, front and optimizer"), ...rows("lattice", optimized));
  table(
    ["growth exponent, first size to last", "native", "WebAssembly"],
    ...[
      ["front", "front", front],
      ["front and optimizer", "optimized", optimized],
      ["whole run", "optimized", (run) => run.seconds],
      ["whole run, with a lattice", "lattice", (run) => run.seconds],
    ].map(([name, kind, secondsOf]) => [
      name,
      ...["native", "wasm"].map((engine) =>
        exponent(
          runs.map((run) => run[engine][kind]),
          secondsOf,
        ).toFixed(3),
      ),
    ]),
  );
}

function showCrossing(surface) {
  console.log("## The crossing check\n");
  const percent = (share) => `${(100 * share).toFixed(1)} %`;
  const kinds = ["layered", "smallest-first"].flatMap((order) =>
    ["on", "off"].map((filters) => [order, filters]),
  );
  table(
    ["front, native", "tetrahedra per second", "share of the check", "faces per check", "of these analysed"],
    ...kinds.map(([order, filters]) => {
      const clocked = clockFront(order, filters, surface);
      return [
        `${order}, filters ${filters}`,
        perSecond(clocked.tetrahedra, clocked.seconds),
        percent(clocked.crossingShare),
        clocked.facesPerCheck.toFixed(1),
        clocked.analysedPerCheck.toFixed(2),
      ];
    }),
  );
}

function showPeers(ours, { file }) {
  console.log("## Beside others, on the same triangles\n");
  const row = (name, run, spent) => [
    name,
    count(run.tetrahedra),
    seconds(spent),
    perSecond(run.tetrahedra, spent),
    `${degrees(run.minDihedral)}–${degrees(run.maxDihedral)}`,
    run.meanRadiusRatio.toFixed(3),
  ];
  const { native, wasm } = ours;
  const rows = [
    row("Tetrafront, front, native", native.front, front(native.front)),
    row("Tetrafront, front, WebAssembly", wasm.front, front(wasm.front)),
    row("Tetrafront, optimized, native", native.optimized, optimized(native.optimized)),
    row("Tetrafront, optimized, WebAssembly", wasm.optimized, optimized(wasm.optimized)),
  ];
  const found = {};
  for (const name of availablePeers()) {
    const run = runPeer(name, file);
    if (!run.failure) found[name] = run;
    rows.push(run.failure ? [PEERS[name], run.failure, "", "", "", ""] : row(PEERS[name], run, run.seconds));
  }
  table(["", "tetrahedra", "s", "per second", "dihedral angles", "mean radius ratio"], ...rows);
  if (Object.keys(found).length === 0) return console.log(`To see others beside ours: ${INSTALL}\n`);
  const rate = (run, spent) => run.tetrahedra / spent;
  const compare = (peer, kind, spent) => [
    times(rate(native[kind], spent(native[kind])) / rate(peer, peer.seconds)),
    times(rate(wasm[kind], spent(wasm[kind])) / rate(peer, peer.seconds)),
  ];
  const ratios = [];
  if (found["netgen-front"]) {
    ratios.push(["front, of Netgen's front", ...compare(found["netgen-front"], "front", front)]);
  }
  if (found["netgen-default-optimized"]) {
    const peer = found["netgen-default-optimized"];
    ratios.push(["optimized, of Netgen optimized", ...compare(peer, "optimized", optimized)]);
  }
  if (ratios.length > 0) table(["tetrahedra per second", "native", "WebAssembly"], ...ratios);
}

try {
  console.log(`${cpus()[0].model}, ${arch()}; Node ${process.version}\n`);
  const runs = spheres.map(runOurs);
  const at = spheres.findIndex(({ thousands }) => thousands === REFERENCE);
  showSizes(runs);
  showCrossing(spheres[at].surface);
  showPeers(runs[at], spheres[at]);
  if (!runs.every(({ isSame }) => isSame)) process.exitCode = 1;
} finally {
  rmSync(folder, { recursive: true });
}

// Tetrahedra per second of the volume front on a sphere at three sizes, natively and in WebAssembly
// under Node, and how the time grows with the number of tetrahedra: time ~ count^exponent.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { createMesher } from "tetrafront";
import { geodesicSphere, toOff } from "./geodesic-sphere.mjs";

const SIZES = [8, 18, 40]; // about 10 k, 90 k and 900 k tetrahedra
const REPEATS = 3; // the least time counts: everything else on the machine only adds

const fill = process.env.TETRAFRONT_FILL;
if (!fill) {
  console.error("Run this by `npm run bench front`: it needs the native program in TETRAFRONT_FILL.");
  process.exit(2);
}

function native(file) {
  let best;
  for (let i = 0; i < REPEATS; ++i) {
    const lines = execFileSync(fill, [file], { encoding: "utf8" }).trim().split("\n");
    const values = Object.fromEntries(lines.map((line) => line.split(" ")));
    const run = {
      tetrahedra: Number(values.tetrahedra),
      seconds: Number(values.volumeSeconds),
      fingerprint: values.fingerprint,
    };
    if (best === undefined || run.seconds < best.seconds) best = run;
  }
  return best;
}

async function webAssembly(mesher, surface) {
  let best;
  for (let i = 0; i < REPEATS; ++i) {
    const { report } = await mesher.fillSurface({
      points: surface.points.slice(),
      triangles: surface.triangles.slice(),
    });
    const run = {
      tetrahedra: report.tetrahedra,
      seconds: report.seconds.volume,
      fingerprint: report.fingerprint,
    };
    if (best === undefined || run.seconds < best.seconds) best = run;
  }
  return best;
}

/** Slope of log time over log count between the first and the last run. */
function exponent(runs) {
  const first = runs[0];
  const last = runs[runs.length - 1];
  return Math.log(last.seconds / first.seconds) / Math.log(last.tetrahedra / first.tetrahedra);
}

const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-bench-"));
const mesher = await createMesher();
const natives = [];
const wasms = [];
const rate = (run) => `${Math.round(run.tetrahedra / run.seconds / 1000)} k/s`.padStart(10);
console.log("triangles  tetrahedra     native       wasm  wasm/native  same mesh");
try {
  for (const n of SIZES) {
    const surface = geodesicSphere(n);
    const file = path.join(folder, `sphere-${n}.off`);
    writeFileSync(file, toOff(surface));
    const one = native(file);
    const other = await webAssembly(mesher, surface);
    natives.push(one);
    wasms.push(other);
    console.log(
      `${String(surface.triangles.length / 3).padStart(9)} ${String(one.tetrahedra).padStart(11)} ` +
        `${rate(one)} ${rate(other)} ${(one.seconds / other.seconds).toFixed(2).padStart(12)}  ` +
        `${one.fingerprint === other.fingerprint ? "yes" : "NO"}`,
    );
  }
} finally {
  mesher.dispose();
  rmSync(folder, { recursive: true });
}
console.log(`growth exponent: native ${exponent(natives).toFixed(3)}, wasm ${exponent(wasms).toFixed(3)}`);
if (natives.some((run, i) => run.fingerprint !== wasms[i].fingerprint)) process.exit(1);

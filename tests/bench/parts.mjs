// Prints a table of parts as CAD programs export them, from STL file to volume mesh: ours, with automatic sizes and with
// small details dropped, and other meshers, if they are installed. TETRAFRONT_PARTS may name a folder of more STL files.
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { arch, cpus, tmpdir } from "node:os";
import path from "node:path";
import { diagonalOf } from "./support/diagonal.mjs";
import { NEEDLE_PARTS, toStl } from "./support/needle-parts.mjs";
import {
  availablePartPeers,
  INSTALL_PART_PEERS,
  installMissingPartPeers,
  runPartPeer,
} from "./support/peers.mjs";
import { createMesher } from "../../wasm/dist/index.js";
import { readSurfaceFile } from "../../wasm/dist/node.js";

/** Length of dropped details / diagonal. */
const DETAIL = 1 / 2000;

const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-parts-"));
const own = Object.entries(NEEDLE_PARTS).map(([name, make]) => {
  const file = path.join(folder, `${name.replaceAll(/[^a-z0-9]+/g, "-")}.stl`);
  writeFileSync(file, toStl(make()));
  return { name, file };
});
const given = process.env.TETRAFRONT_PARTS;
const others = given
  ? readdirSync(given)
      .filter((name) => /\.stl$/i.test(name))
      .map((name) => ({ name, file: path.join(given, name) }))
  : [];

const degrees = (value) => `${value.toFixed(1)}°`;
const row = (cells) => console.log(`| ${cells.join(" | ")} |`);

function volumeOf({ points, triangles }) {
  let sum = 0;
  const at = (corner, k) => points[3 * triangles[corner] + k] - points[k];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => [0, 1, 2].map((k) => at(t + i, k)));
    sum +=
      a[0] * (b[1] * c[2] - b[2] * c[1]) +
      a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return Math.abs(sum / 6);
}

/** Remeshes and fills a part; `failure` says why that was impossible. */
async function runOurs(mesher, surface, options) {
  const began = performance.now();
  try {
    const remesh = await mesher.remeshSurface(surface, options);
    const remeshed = performance.now();
    const { report } = await mesher.fillSurface(remesh.mesh);
    if (report.status !== "done") return { failure: report.diagnostics[0]?.code ?? report.status };
    return {
      triangles: remesh.mesh.triangles.length / 3,
      smallestAngle: remesh.smallestAngle,
      deviation: remesh.deviation / diagonalOf(surface),
      volumeError: Math.abs(volumeOf(remesh.mesh) / volumeOf(surface) - 1),
      perSecond: remesh.mesh.triangles.length / 3 / ((remeshed - began) / 1000),
      tetrahedra: report.tetrahedra,
      minDihedral: report.dihedral.min,
      meanRadiusRatio: report.radiusRatio.mean,
      seconds: (performance.now() - began) / 1000,
    };
  } catch (error) {
    return { failure: error.diagnostics?.[0]?.code ?? error.message };
  }
}

const share = (rows, test) => `${Math.round((100 * rows.filter(test).length) / Math.max(1, rows.length))} %`;

function printOurs(title, results) {
  console.log(`\n${title}\n`);
  row(["part", "triangles", "smallest angle", "deviation / diagonal", "volume error", "triangles / s", "tetrahedra", "smallest dihedral", "mean radius ratio", "s"]); // prettier-ignore
  row(Array.from({ length: 10 }, (_, i) => (i === 0 ? "---" : "---:")));
  for (const { name, run } of results) {
    if (run.failure) row([name, run.failure, ...Array.from({ length: 8 }, () => "")]);
    else
      row([
        name,
        run.triangles,
        degrees(run.smallestAngle),
        run.deviation.toExponential(1),
        `${(100 * run.volumeError).toFixed(2)} %`,
        Math.round(run.perSecond),
        run.tetrahedra,
        degrees(run.minDihedral),
        run.meanRadiusRatio.toFixed(3),
        run.seconds.toFixed(1),
      ]);
  }
  const runs = results.map(({ run }) => run).filter(({ failure }) => !failure);
  console.log(
    `\n${runs.length} of ${results.length} meshed; of these, smallest dihedral angle at least 10°: ` +
      `${share(runs, ({ minDihedral }) => minDihedral >= 10)}, at least 20°: ` +
      `${share(runs, ({ minDihedral }) => minDihedral >= 20)}`,
  );
}

function printPeers(parts) {
  const peers = availablePartPeers();
  if (peers.length === 0) {
    console.log(`\nNo other mesher is installed. To compare: ${INSTALL_PART_PEERS}`);
    return;
  }
  console.log("\nOther meshers, their defaults\n");
  row(["part", "mesher", "tetrahedra", "smallest dihedral", "mean radius ratio", "s"]);
  row(["---", "---", "---:", "---:", "---:", "---:"]);
  for (const { name, file } of parts) {
    for (const peer of peers) {
      const run = runPartPeer(peer, file);
      if (run.failure) row([name, peer, run.failure, "", "", ""]);
      else
        row([
          name,
          peer,
          run.tetrahedra,
          degrees(run.minDihedral),
          run.meanRadiusRatio.toFixed(3),
          run.seconds.toFixed(1),
        ]);
    }
  }
  const install = installMissingPartPeers();
  if (install) console.log(`\nNot all meshers were tried. To try the others: ${install}`);
}

const mesher = await createMesher();
try {
  console.log(`${cpus()[0]?.model.trim() ?? arch()}, Node ${process.version}, WebAssembly`);
  const surfaces = [];
  for (const part of [...own, ...others]) {
    surfaces.push({ ...part, surface: (await readSurfaceFile(part.file)).value });
  }
  for (const [title, detail] of [
    ["Automatic sizes, all details kept", 0],
    ["Automatic sizes, details below 1/2000 of the diagonal dropped", DETAIL],
  ]) {
    const results = [];
    for (const { name, surface } of surfaces) {
      const options = detail > 0 ? { dropDetails: detail * diagonalOf(surface) } : {};
      results.push({ name, run: await runOurs(mesher, surface, options) });
    }
    printOurs(title, results);
  }
  printPeers(surfaces);
} finally {
  mesher.dispose();
  rmSync(folder, { recursive: true, force: true });
}

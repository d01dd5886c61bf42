// Prints what a lattice inside changes: spheres of growing size, and CAD parts remeshed by automatic sizes, each meshed by the
// front alone and with a lattice. TETRAFRONT_PARTS may name a folder of STL files.
import { readdirSync } from "node:fs";
import path from "node:path";
import { geodesicSphere } from "./support/geodesic-sphere.mjs";
import { NEEDLE_PARTS } from "./support/needle-parts.mjs";
import { createMesher } from "../../wasm/dist/index.js";
import { readSurfaceFile } from "../../wasm/dist/node.js";

/** Subdivisions of the icosahedron's edges. */
const SPHERES = (process.env.TETRAFRONT_SPHERES ?? "6,8,9,11,14,19,27,41")
  .split(",")
  .filter(Boolean)
  .map(Number);
const given = process.env.TETRAFRONT_PARTS;

const mesher = await createMesher();
const row = (cells) => console.log(`| ${cells.join(" | ")} |`);
const HEAD = ["body", "front: elements", "s", "least angle", "mean radius ratio", "lattice: elements", "of them lattice", "s", "least angle", "mean radius ratio"]; // prettier-ignore

async function runBothWays(name, surface) {
  const cells = [];
  for (const interior of ["front", "lattice"]) {
    const { report } = await mesher.fillSurface(surface, { interior });
    if (report.status !== "done") {
      cells.push(report.diagnostics[0]?.code ?? report.status, ...Array.from({ length: interior === "lattice" ? 4 : 3 }, () => "")); // prettier-ignore
      continue;
    }
    cells.push(report.tetrahedra);
    if (interior === "lattice") {
      cells.push(`${((100 * report.interior.lattice) / report.tetrahedra).toFixed(0)} %`);
    }
    cells.push(
      (report.seconds.volume + report.seconds.optimize).toFixed(2),
      `${report.dihedral.min.toFixed(1)}°`,
      report.radiusRatio.mean.toFixed(3),
    );
  }
  row([name, ...cells]);
}

row(HEAD);
row(HEAD.map((_, i) => (i === 0 ? "---" : "---:")));
for (const divisions of SPHERES) {
  await runBothWays(`sphere of ${20 * divisions ** 2} triangles`, geodesicSphere(divisions));
}
const parts = Object.entries(NEEDLE_PARTS).map(([name, make]) => ({ name, read: make }));
if (given) {
  for (const name of readdirSync(given)) {
    if (/\.stl$/i.test(name))
      parts.push({ name, read: async () => (await readSurfaceFile(path.join(given, name))).value });
  }
}
for (const { name, read } of parts) {
  try {
    const surface = read();
    const { mesh } = await mesher.remeshSurface(surface);
    await runBothWays(name, mesh);
  } catch (error) {
    row([name, error.diagnostics?.[0]?.code ?? error.message, ...Array.from({ length: 8 }, () => "")]);
  }
}
mesher.dispose?.();
process.exit(0);

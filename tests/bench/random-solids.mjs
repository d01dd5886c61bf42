// Meshes solids that the kernel makes with random dimensions, each written as STEP or BREP file, and prints those that fail, have angles
// below 20 degrees, or nodes off their faces, and the counts at the end. With --features, the features are random, too: faces
// are often nearly tangent to others then.
//
//     node tests/bench/random-solids.mjs [COUNT] [FIRST] [--features]
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { meshFile } from "../../wasm/dist/node.js";
import { moduleServer } from "./support/modules.mjs";

const words = process.argv.slice(2);
const areRandom = words.includes("--features");
const [COUNT = 100, FIRST = 1] = words.filter((word) => word !== "--features").map(Number);
/** Degrees. */
const GOOD = 20;

const server = await moduleServer();
const { randomFeatures, randomPart } = await server.ssrLoadModule("/tests/support/random-features.ts");
const { kernelVolume, stepOf, testKernel } = await server.ssrLoadModule("/tests/support/kernel-shapes.ts");
const { withShape } = await server.ssrLoadModule("/wasm/dist/cad/features/evaluate.js");

const kernel = await testKernel();
const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-solids-"));
const counts = { solids: 0, meshed: 0, good: 0, onFaces: 0, elements: 0 };
const seconds = { cpu: 0 };

for (let seed = FIRST; seed < FIRST + COUNT; seed++) {
  const features = areRandom ? randomFeatures(kernel, seed * 7919) : randomPart(seed);
  const isStep = seed % 2 === 0;
  const file = path.join(folder, `${seed}.${isStep ? "step" : "brep"}`);
  const { result: volume, failures } = withShape(kernel, features, (shape) => {
    writeFileSync(file, isStep ? stepOf(kernel, shape) : kernel.BRepToolsWrapper.Write(shape));
    return kernelVolume(kernel, shape);
  });
  if (failures.length > 0) console.log(`${seed}: ${failures[0].message}`);
  if (volume === undefined) continue;
  counts.solids++;
  const before = process.cpuUsage();
  const made = await meshFile(file);
  const { user, system } = process.cpuUsage(before);
  seconds.cpu += (user + system) / 1e6;
  if (!made.success) {
    console.log(`${seed}: ${made.message}`);
    continue;
  }
  counts.meshed++;
  const { report } = made;
  counts.elements += report.tetrahedra;
  const { min } = report.dihedral;
  if (min >= GOOD) counts.good++;
  if (report.remesh?.onFaces) counts.onFaces++;
  const filled = report.regions.reduce((sum, region) => sum + region.volume, 0);
  const findings = [];
  if (min < GOOD) findings.push(`${min.toFixed(1)}°`);
  if (report.remesh?.onFaces !== true) findings.push("not on its faces");
  const error = filled / volume - 1;
  if (Math.abs(error) > 0.01) findings.push(`volume ${(100 * error).toFixed(2)} %`);
  const unplaced = report.remesh?.placement?.unplaced;
  if (unplaced) findings.push(`${unplaced} nodes beside their faces`);
  if (findings.length > 0)
    console.log(
      `${seed} (${features.map(({ type }) => type).join(", ")}): ${report.tetrahedra} elements, ${findings.join(", ")}`,
    );
}
await server.close();
rmSync(folder, { recursive: true });
console.log(counts, `${Math.round(counts.elements / seconds.cpu)} elements per processor second`);
process.exit(0);

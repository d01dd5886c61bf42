// Adapts meshes to the four metrics of the Unstructured Grid Adaptation Working Group, beside MMG, and to four analytic functions
// of NASA's refine, whose interpolation error should fall as N^(-2/3).
//   npm run bench -- adaptive
// TETRAFRONT_CASES      names of the metrics and functions, separated by commas; default: all
// TETRAFRONT_ADAPT      folder with cube-cylinder.step, which then is the model; default: a cylinder of chords
// TETRAFRONT_ELEMENTS   numbers of elements for the functions; default 4000,8000,16000,32000
// TETRAFRONT_CYCLES     cycles for each number; default 3
// MMG3D                 the program mmg3d; default: the one in PATH
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { createMesher, meshFile, readMesh, writeMesh } from "tetrafront";
import { FUNCTIONS, interpolationError } from "./support/analytic-functions.mjs";
import { caseSurface, METRIC_CASES, metricsAt, metricStatistics } from "./support/metric-cases.mjs";

/** Passes of each program: metric at the nodes, adaptation. */
const PASSES = 5;

const { env } = process;
const chosen = env.TETRAFRONT_CASES?.split(",");
const isChosen = ([name]) => chosen === undefined || chosen.includes(name);
const mmg = env.MMG3D ?? "mmg3d";
const hasMmg = spawnSync(mmg, ["-h"]).error === undefined;

const seconds = async (work) => {
  const before = process.cpuUsage();
  const result = await work();
  const { user, system } = process.cpuUsage(before);
  return { result, seconds: (user + system) / 1e6 };
};

const withMetric = (mesh, metricAt) => ({
  ...mesh,
  nodeData: new Map([["metric", { components: 6, values: metricsAt(mesh.points, metricAt) }]]),
});

async function startMesh(mesher, model) {
  const file = path.join(env.TETRAFRONT_ADAPT ?? "", "cube-cylinder.step");
  if (model === "cylinder" && env.TETRAFRONT_ADAPT !== undefined && existsSync(file)) {
    const options = { fileName: file, mesher, surface: "remesh", anglePerEdge: 6, optimization: "fast" };
    const made = await meshFile(readFileSync(file), options);
    if (!made.success) throw new Error(made.message);
    return made.mesh;
  }
  const surface = caseSurface(model);
  const { mesh, report } = await mesher.meshSurface(surface, {
    surface: "remesh",
    anglePerEdge: 6,
    optimization: "fast",
  });
  if (report.status !== "done") throw new Error(report.diagnostics[0]?.message);
  return mesh;
}

async function adapted(mesher, start, metricAt) {
  let mesh = start;
  for (let pass = 0; pass < PASSES; ++pass)
    ({ mesh } = await mesher.adaptMesh(start, withMetric(mesh, metricAt)));
  return mesh;
}

/** Runs MMG on the same start mesh; undefined if there is no MMG. */
async function adaptedByMmg(start, metricAt) {
  if (!hasMmg) return undefined;
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-mmg-"));
  try {
    let mesh = start;
    let total = 0;
    for (let pass = 0; pass < PASSES; ++pass) {
      for (const { fileName, bytes } of await writeMesh(withMetric(mesh, metricAt), "in.mesh")) {
        writeFileSync(path.join(folder, fileName), bytes);
      }
      const began = performance.now();
      const { status, stdout } = spawnSync(mmg, ["-v", "0", "-in", "in.mesh", "-sol", "in.sol", "-out", "out.mesh", "-hgrad", "-1"], { cwd: folder, encoding: "utf8" }); // prettier-ignore
      total += (performance.now() - began) / 1000;
      if (status !== 0) throw new Error(`${mmg} failed: ${stdout.slice(-400)}`);
      const read = await readMesh(readFileSync(path.join(folder, "out.mesh")), { fileName: "out.mesh" });
      if (!read.success) throw new Error(read.errors[0].message);
      mesh = read.value;
    }
    return { mesh, seconds: total };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

const statisticsText = (mesh, metricAt, time) => {
  const { elements, unit, least, mean } = metricStatistics(mesh, metricAt);
  return `${(100 * unit).toFixed(2)} % | ${least.toFixed(3)} / ${mean.toFixed(3)} | ${elements} | ${time.toFixed(1)}`;
};

async function compareMetrics(mesher) {
  console.log("| case | unit edges | least / mean quality | elements | s | MMG: unit edges | least / mean quality | elements | s | best published |"); // prettier-ignore
  console.log("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
  for (const [name, { metricAt, model, published }] of Object.entries(METRIC_CASES).filter(isChosen)) {
    const start = await startMesh(mesher, model);
    const { result, seconds: time } = await seconds(() => adapted(mesher, start, metricAt));
    const other = await adaptedByMmg(start, metricAt);
    const beside = other === undefined ? "| | | " : statisticsText(other.mesh, metricAt, other.seconds);
    console.log(`| ${name} | ${statisticsText(result, metricAt, time)} | ${beside} | ${published} |`);
  }
  if (!hasMmg)
    console.log(
      "\nThere is no mmg3d: pip install mmgpy into a virtual environment, and set MMG3D to its bin/mmg3d.",
    );
}

async function compareOrders(mesher) {
  const counts = (env.TETRAFRONT_ELEMENTS ?? "4000,8000,16000,32000").split(",").map(Number);
  const cycles = Number(env.TETRAFRONT_CYCLES ?? 3);
  console.log(
    "\n| function | elements | L2 error | error N^(2/3) | order |\n| --- | ---: | ---: | ---: | ---: |",
  );
  for (const [name, valueAt] of Object.entries(FUNCTIONS).filter(isChosen)) {
    let mesh = await startMesh(mesher, "cube");
    const rows = [];
    for (const elements of counts) {
      const solve = ({ points }) => {
        const values = Float64Array.from({ length: points.length / 3 }, (_, n) =>
          valueAt(points.subarray(3 * n, 3 * n + 3)),
        );
        return [{ name, components: 1, values }];
      };
      for await (const { next } of mesher.adapt(mesh, solve, { cycles, elements, growth: Infinity }))
        mesh = next.mesh;
      const row = { count: mesh.tetrahedra.length / 4, error: interpolationError(mesh, valueAt) };
      const before = rows.at(-1);
      rows.push(row);
      const order = before === undefined ? "" : (-Math.log(row.error / before.error) / Math.log(row.count / before.count)).toFixed(3); // prettier-ignore
      const scaled = row.error * row.count ** (2 / 3);
      console.log(
        `| ${name} | ${row.count} | ${row.error.toExponential(3)} | ${scaled.toFixed(3)} | ${order} |`,
      );
    }
    console.log(`| ${name} | all | | | ${slope(rows).toFixed(3)} (2/3 = 0.667) |`);
  }
}

/** Returns the order of convergence by least squares. */
function slope(rows) {
  const xs = rows.map(({ count }) => Math.log(count));
  const ys = rows.map(({ error }) => Math.log(error));
  const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [x, y] = [mean(xs), mean(ys)];
  const above = xs.reduce((sum, value, i) => sum + (value - x) * (ys[i] - y), 0);
  return -above / xs.reduce((sum, value) => sum + (value - x) ** 2, 0);
}

const mesher = await createMesher();
try {
  if (Object.entries(METRIC_CASES).some(isChosen)) await compareMetrics(mesher);
  if (Object.entries(FUNCTIONS).some(isChosen)) await compareOrders(mesher);
} finally {
  mesher.dispose();
}

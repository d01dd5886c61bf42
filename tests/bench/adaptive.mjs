// Adapts meshes to the four metrics of the Unstructured Grid Adaptation Working Group, and to four analytic functions of NASA's
// refine, whose interpolation error should fall as N^(-2/3), beside MMG, which gets the same metrics.
//   npm run bench -- adaptive
// TETRAFRONT_CASES      names of the metrics and functions, separated by commas; default: all
// TETRAFRONT_ADAPT      folder with cube-cylinder.step, which then is the model; default: a cylinder of chords
// TETRAFRONT_ELEMENTS   numbers of elements for the functions; default 8000,16000,32000,64000
// TETRAFRONT_CYCLES     cycles for each number; default 3
// MMG3D                 the program mmg3d; default: the one in PATH
import { existsSync, readFileSync } from "node:fs";
import path from "node:path";
import { createMesher, meshFile } from "tetrafront";
import { FUNCTIONS, interpolationError, valuesAt } from "./support/analytic-functions.mjs";
import { caseSurface, METRIC_CASES, metricsAt, metricStatistics } from "./support/metric-cases.mjs";
import { adaptByMmg, hasMmg, INSTALL_MMG } from "./support/mmg.mjs";

/** Passes of each program: metric at the nodes, adaptation. */
const PASSES = 5;

const { env } = process;
const chosen = env.TETRAFRONT_CASES?.split(",");
const isChosen = ([name]) => chosen === undefined || chosen.includes(name);

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
  let made = { mesh: start };
  let total = 0;
  for (let pass = 0; pass < PASSES; ++pass) {
    made = await adaptByMmg(withMetric(made.mesh, metricAt));
    total += made.seconds;
  }
  return { mesh: made.mesh, seconds: total };
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
}

/** What makes the next mesh from a solved one; `first`: the mesh of the first cycle. */
const programs = (mesher) => [
  {
    title: "Tetrafront",
    next: async (first, sized) => {
      const { result, seconds: time } = await seconds(() => mesher.adaptMesh(first, sized));
      return { mesh: result.mesh, seconds: time };
    },
  },
  ...(hasMmg ? [{ title: "MMG", next: (_, sized) => adaptByMmg(metricAlone(sized)) }] : []),
];

const metricAlone = (mesh) => ({ ...mesh, nodeData: new Map([["metric", mesh.nodeData.get("metric")]]) });

/** Returns the number of elements and the error of the mesh after the last cycle for each number that is asked for. */
async function convergence(mesher, { next }, [name, valueAt]) {
  const counts = (env.TETRAFRONT_ELEMENTS ?? "8000,16000,32000,64000").split(",").map(Number);
  const first = await startMesh(mesher, "cube");
  let mesh = first;
  const rows = [];
  for (const elements of counts) {
    let total = 0;
    for (let cycle = 0; cycle < Number(env.TETRAFRONT_CYCLES ?? 3); ++cycle) {
      const field = { name, components: 1, values: valuesAt(mesh, valueAt) };
      // No limit of the growth: the metric is the optimal one for the norm.
      const options = { elements, growth: Infinity };
      const sized = await mesher.sizeFromSolution(mesh, [field], options);
      const made = await next(first, sized.mesh);
      mesh = made.mesh;
      total += made.seconds;
    }
    rows.push({
      count: mesh.tetrahedra.length / 4,
      error: interpolationError(mesh, valueAt),
      seconds: total,
    });
  }
  return rows;
}

const scaledError = ({ error, count }) => error * count ** (2 / 3);

async function compareOrders(mesher) {
  console.log("\n| function | program | elements | L2 error | error N^(2/3) | order | s |");
  console.log("| --- | --- | ---: | ---: | ---: | ---: | ---: |");
  for (const named of Object.entries(FUNCTIONS).filter(isChosen)) {
    for (const program of programs(mesher)) {
      const rows = await convergence(mesher, program, named);
      rows.forEach((row, r) => {
        const order = r === 0 ? "" : slope(rows.slice(r - 1, r + 1)).toFixed(3);
        const errors = `${row.error.toExponential(3)} | ${scaledError(row).toFixed(3)}`;
        console.log(
          `| ${named[0]} | ${program.title} | ${row.count} | ${errors} | ${order} | ${row.seconds.toFixed(1)} |`,
        );
      });
      console.log(`| ${named[0]} | ${program.title} | all | | | ${slope(rows).toFixed(3)} (2/3 = 0.667) | |`);
    }
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
  if (!hasMmg) console.log(`${INSTALL_MMG}\n`);
  if (Object.entries(METRIC_CASES).some(isChosen)) await compareMetrics(mesher);
  if (Object.entries(FUNCTIONS).some(isChosen)) await compareOrders(mesher);
} finally {
  mesher.dispose();
}

// Cost of a large background grid: tetrahedra per second of the front in a unit cube, with a uniform size, a
// covering grid of one tetrahedron, and a generated mesh of about 100 000 tetrahedra as grid, for a model and for
// a given surface; and the time to make a grid from a mesh.
import { createMesher } from "tetrafront";

const SIZE = 0.0425; // about 110 000 tetrahedra in the unit cube
const REPEATS = 3; // the minimum counts: other work on the machine only adds time
const FRONT_ONLY = { optimization: "none" };

/** The unit cube as a project without background grid. */
function cube() {
  const corner = (i) => [i & 1, (i >> 1) & 1, (i >> 2) & 1];
  const ids = [0, 1, 2, 3, 4, 5, 6, 7];
  const edges = ids.flatMap((i) =>
    [1, 2, 4].filter((bit) => (i & bit) === 0).map((bit) => [i + 1, (i | bit) + 1]),
  );
  const line = (from, to) => {
    const forward = edges.findIndex(([a, b]) => a === from && b === to);
    return forward >= 0 ? forward + 1 : -(edges.findIndex(([a, b]) => a === to && b === from) + 1);
  };
  const faces = [
    [1, 3, 4, 2],
    [5, 6, 8, 7],
    [1, 2, 6, 5],
    [3, 7, 8, 4],
    [1, 5, 7, 3],
    [2, 4, 8, 6],
  ];
  return {
    format: "tetrafront-project",
    version: 2,
    name: "Unit cube",
    points: ids.map((i) => ({ id: i + 1, position: corner(i) })),
    lines: edges.map((points, i) => ({ id: i + 1, type: "straight", points })),
    patches: faces.map((face, p) => ({
      id: p + 1,
      type: "planar",
      loops: [face.map((from, i) => line(from, face[(i + 1) % 4]))],
    })),
    background: { nodes: [], tetrahedra: [] },
  };
}

/** Returns the fastest of several runs; ends the benchmark if a run is not done. */
async function best(run) {
  let least;
  for (let i = 0; i < REPEATS; ++i) {
    const { report } = await run();
    if (report.status !== "done") throw new Error(`${report.status}: ${report.diagnostics[0]?.message}`);
    if (least === undefined || report.seconds.volume < least.seconds.volume) least = report;
  }
  return least;
}

const mesher = await createMesher();
try {
  const project = cube();
  const { volume, surface } = await mesher.meshProject(project, { size: SIZE, ...FRONT_ONLY });
  const began = performance.now();
  const background = await mesher.backgroundFromMesh(volume);
  const made = performance.now() - began;
  const count = background.tetrahedra.length / 4;
  const one = {
    ...project,
    background: await mesher.coverProject(project, { size: SIZE, shape: "tetrahedron" }),
  };
  console.log(`a grid of ${count} tetrahedra, made of a mesh in ${made.toFixed(0)} ms`);
  console.log(
    "sizes from                           tetrahedra      front   check [s]  total [s]  of uniform",
  );

  let uniform;
  const runs = [
    ["uniform", () => mesher.meshProject(project, { size: SIZE, ...FRONT_ONLY })],
    ["a grid of one tetrahedron", () => mesher.meshProject(one, FRONT_ONLY)],
    [`a grid of ${count}`, () => mesher.meshProject(project, { background, ...FRONT_ONLY })],
    ["a surface's own edges", () => mesher.fillSurface(surface, FRONT_ONLY)],
    [`a surface, a grid of ${count}`, () => mesher.fillSurface(surface, { background, ...FRONT_ONLY })],
  ];
  for (const [name, run] of runs) {
    const { tetrahedra, seconds } = await best(run);
    const rate = tetrahedra / seconds.volume;
    uniform ??= rate;
    console.log(
      `${name.padEnd(36)} ${String(tetrahedra).padStart(10)} ${`${Math.round(rate / 1000)} k/s`.padStart(10)} ` +
        `${seconds.check.toFixed(2).padStart(11)} ${seconds.total.toFixed(2).padStart(10)} ` +
        `${(rate / uniform).toFixed(2).padStart(11)}`,
    );
  }
} finally {
  mesher.dispose();
}

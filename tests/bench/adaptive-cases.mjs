// Five adapted meshes beside uniform ones: two fields that are given, two problems that the app's solver solves, and layers along a
// wall. The exact field is known in all of them. Prints the table of docs/ADAPTIVE.md.
//   npm run bench -- adaptive-cases
// TETRAFRONT_ELEMENTS   numbers of elements; default 4000,16000
// TETRAFRONT_CYCLES     cycles for each number; default 4
import { createMesher } from "tetrafront";
import { fieldError, valuesAt } from "./support/analytic-functions.mjs";
import { caseSurface, prism } from "./support/metric-cases.mjs";
import { moduleServer } from "./support/modules.mjs";

const { env } = process;
const counts = (env.TETRAFRONT_ELEMENTS ?? "4000,16000").split(",").map(Number);
const cycles = Number(env.TETRAFRONT_CYCLES ?? 4);

const server = await moduleServer();
const { assembleScalar } = await server.ssrLoadModule("/web/solve/scalar-problems.ts");
const solvers = await server.ssrLoadModule("/web/solve/linear-solvers.ts");
const mesher = await createMesher();

/** A field that is given everywhere, so that its error is that of the interpolation. */
const given = (valueAt) => (mesh) => valuesAt(mesh, valueAt);

/** Solves a problem without conditions, with the exact values at the nodes where `isGivenAt` is true. */
const solved = (problem, valueAt, isGivenAt) => (mesh) => {
  const { system, unknowns } = assembleScalar(mesh, { ...problem, conditions: new Map() }, null);
  for (let node = 0; node < unknowns.length; ++node) {
    const position = mesh.points.subarray(3 * node, 3 * node + 3);
    if (!isGivenAt(position)) continue;
    system.isGiven[node] = 1;
    unknowns[node] = valueAt(position);
  }
  const { conjugateGradients, stabilizedBiconjugateGradients } = solvers;
  (problem.kind === "heat" ? conjugateGradients : stabilizedBiconjugateGradients)(system, unknowns);
  return unknowns;
};

const sphere = ([x, y, z]) => Math.tanh(20 * (Math.hypot(x, y, z) - 0.9));

/** Two plane layers that cross: values from −2 to 2. */
const crossing = ([x, y, z]) => Math.tanh(20 * (x + y + z - 1.5)) + Math.tanh(20 * (x - y));

/** The solution of −Δu = 0 beside a re-entrant edge between the planes y = 0 and x = 0, on which it is 0. */
function corner([x, y]) {
  const angle = Math.atan2(y, x);
  return Math.hypot(x, y) ** (2 / 3) * Math.sin((2 / 3) * (angle < -1e-9 ? angle + 2 * Math.PI : angle));
}
/** A square of 1 less a quarter, with the re-entrant corner at 0. */
const L_RING = [[0, 0], [0.5, 0], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0, -0.5]]; // prettier-ignore
const lShape = () => prism(L_RING, [1, 2, 3, 4].map((k) => [0, k, k + 1]), undefined, 0.25); // prettier-ignore
const isOnSides = ([x, y]) =>
  Math.max(Math.abs(x), Math.abs(y)) > 0.5 - 1e-9 ||
  (x > -1e-9 && Math.abs(y) < 1e-9) ||
  (y < 1e-9 && Math.abs(x) < 1e-9);

const DIFFUSIVITY = 0.01;
/** The solution of u,x − 0.01 Δu = 0 with 0 at x = 0 and 1 at x = 1. */
const outflow = ([x]) => Math.expm1(x / DIFFUSIVITY) / Math.expm1(1 / DIFFUSIVITY);

const wall = ([x, y]) => Math.exp((0.5 - Math.hypot(x, y)) / 0.004);

const heat = { kind: "heat", conductivity: 1, source: 0 };
const advection = { kind: "advection", diffusivity: DIFFUSIVITY, velocity: [1, 0, 0], source: 0 };

const CASES = [
  {
    name: "spherical layer",
    surface: () => caseSurface("cube"),
    exact: sphere,
    solve: given(sphere),
    adapted: followField,
  },
  {
    name: "two crossing layers",
    surface: () => caseSurface("cube"),
    exact: crossing,
    solve: given(crossing),
    adapted: followField,
  },
  {
    name: "heat at a re-entrant edge",
    surface: lShape,
    exact: corner,
    solve: solved(heat, corner, isOnSides),
    adapted: followField,
  },
  {
    name: "advection with diffusion",
    surface: () => caseSurface("cube"),
    exact: outflow,
    solve: solved(advection, outflow, ([x]) => x < 1e-9 || x > 1 - 1e-9),
    adapted: followField,
  },
  {
    name: "layers along a cylinder",
    surface: () => caseSurface("cylinder"),
    exact: wall,
    solve: given(wall),
    adapted: layers,
  },
];

const asField = (values) => ({ name: "u", components: 1, values });

/** Returns the mesh after the last cycle for each number of elements. */
async function* followField(first, solve) {
  let mesh = first;
  for (const elements of counts) {
    let after;
    for (let cycle = 0; cycle < cycles; ++cycle) {
      const sized = await mesher.sizeFromSolution(mesh, [asField(solve(mesh))], { elements });
      ({ mesh, after } = await mesher.adaptMesh(first, sized.mesh));
    }
    yield { mesh, after };
  }
}

/** Returns a mesh with layers along the patch of the cylinder for two first heights. */
async function* layers(first) {
  for (const [firstHeight, count] of [
    [0.002, 8],
    [0.001, 12],
  ])
    // prettier-ignore
    yield mesher.addLayers(first, [{ patch: first.patches[2].name, firstHeight, growth: 1.2, count }]);
}

/** Returns a mesh of about as many elements of one size. */
async function uniform(first, elements) {
  let mesh = first;
  for (let pass = 0; pass < 2; ++pass) {
    const sized = await mesher.sizeFromSolution(mesh, [asField(valuesAt(mesh, () => 0))], { elements });
    ({ mesh } = await mesher.adaptMesh(first, sized.mesh));
  }
  return mesh;
}

async function firstMesh(surface) {
  const { mesh, report } = await mesher.meshSurface(surface, { surface: "remesh", optimization: "fast" });
  if (report.status !== "done") throw new Error(report.diagnostics[0]?.message);
  return mesh;
}

const percent = (share) => `${(100 * share).toFixed(2)} %`;

async function printCase({ name, surface, exact, solve, adapted }) {
  const first = await firstMesh(surface());
  const errorOn = (mesh) => fieldError(mesh, solve(mesh), exact);
  for await (const { mesh, after } of adapted(first, solve)) {
    const even = await uniform(first, after.tetrahedra);
    const [error, evenError] = [mesh, even].map(errorOn);
    const quality = `${percent(after.unitEdges)} | ${after.leastQuality.toFixed(2)}`;
    const beside = `${even.tetrahedra.length / 4} | ${evenError.toExponential(2)}`;
    console.log(
      `| ${name} | ${after.tetrahedra} | ${quality} | ${error.toExponential(2)} | ${beside} | ${(evenError / error).toFixed(1)} |`,
    );
  }
}

try {
  console.log(
    "| case | elements | unit edges | least quality | L2 error | uniform: elements | L2 error | ratio |",
  );
  console.log("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
  for (const one of CASES) await printCase(one);
} finally {
  mesher.dispose();
  await server.close();
}

/** Second-order elements of a mesh: curved by the engine, and described. */
import { inSteps } from "../calls/yielder.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { AnswerOf } from "../engine/calls.js";
import type { RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import type { CurvedEdges, Mesh } from "../mesh/mesh.js";
import { checkFileMesh } from "../mesh/mesh-checks.js";
import type { MeshResult } from "../mesh/report.js";
import type { CurvedMesh, SecondOrderQuality } from "../mesh/second-order.js";
import { beginCall } from "./call-checks.js";
import { checkCurvedEdges, checkImproveInput, unreadableMesh } from "./input-checks.js";
import type { Mesher } from "./mesher-interface.js";
import type { OrderOptions } from "./option-types.js";

type EngineCurved = AnswerOf<"curveEdges">;

/** Curves the edges of a mesh; see `Mesher.curveMesh`. */
export async function curveMesh(
  client: EngineClient,
  mesh: Mesh,
  given: CurvedEdges | undefined,
  control: RunControl,
): Promise<CurvedMesh> {
  beginCall(client, control);
  refuse(checkImproveInput(mesh));
  const curvedEdges = given ?? mesh.trueEdges ?? NO_EDGES;
  refuse(await inSteps(checkFileMesh(mesh), control.signal));
  refuse(checkCurvedEdges(curvedEdges, mesh.points.length / 3));
  const { points, tetrahedra, triangles } = mesh;
  const { edges, middles } = curvedEdges;
  const request = [
    points.slice(),
    tetrahedra.slice(),
    triangles.slice(),
    edges.slice(),
    middles.slice(),
  ] as const;
  const found = await client.ask("curveEdges", request, control);
  if (!found.isReadable) refuse([unreadableMesh()]);
  refuse(invertedErrors(found));
  const moved = withMovedNodes(mesh.points, found);
  const { curvedTetrahedra, scaledJacobians } = found;
  return {
    mesh: { ...mesh, points: moved, curvedEdges: { edges: found.edges, middles: found.middles } },
    secondOrder: qualityOf(found, moved),
    curvedTetrahedra,
    scaledJacobians,
  };
}

/** Returns the control of a run: elements of the second order need the arrays of the first. */
export const inOneOrder = (control: RunControl, { elementOrder }: OrderOptions): RunControl =>
  elementOrder === 2 ? { ...control, inBlocks: false } : control;

/**
 * Returns the result of a run for elements of an order: of order 2 with curved edges, and with their quality in its report. They
 * follow `trueEdges` of the mesh; without those, the surface consists of triangles, whose edges stay straight. A mesh that is not
 * finished stays as it is. The other parts of the report describe the mesh of the run. Rejects as `curveMesh`.
 */
export async function inOrder<Result extends MeshResult>(
  mesher: Pick<Mesher, "curveMesh">,
  result: Result,
  { elementOrder }: OrderOptions,
  control: RunControl,
): Promise<Result> {
  const { mesh, report } = result;
  if (elementOrder !== 2 || report.status !== "done") return result;
  const { trueEdges: boundary } = mesh;
  const curved = await mesher.curveMesh(mesh, boundary ?? NO_EDGES, control);
  const written = boundary === undefined ? mesh : curved.mesh;
  return { ...result, mesh: written, report: { ...report, secondOrder: curved.secondOrder } };
}

const NO_EDGES: CurvedEdges = { edges: new Uint32Array(), middles: new Float64Array() };

function invertedErrors({ invertedTetrahedra }: EngineCurved): Diagnostic[] {
  const [first] = invertedTetrahedra;
  if (first === undefined) return [];
  const count = invertedTetrahedra.length;
  const have = count === 1 ? "has" : "have";
  const message = `${plural(count, "tetrahedron")} ${have} no positive volume with straight edges; the first one is ${first}`;
  const remedy = "Pass a valid mesh: `inspectMesh` counts such elements.";
  return [packageDiagnostic("invalid-mesh", message, remedy)];
}

function withMovedNodes(points: Float64Array, { movedNodes, movedPoints }: EngineCurved): Float64Array {
  if (movedNodes.length === 0) return points;
  const moved = points.slice();
  movedNodes.forEach((node, i) => moved.set(movedPoints.subarray(3 * i, 3 * i + 3), 3 * node));
  return moved;
}

function qualityOf(found: EngineCurved, points: Float64Array): SecondOrderQuality {
  const { curvedTetrahedra, scaledJacobians, straightened } = found;
  const valueOf = (tetrahedron: number) => scaledJacobians[curvedTetrahedra.indexOf(tetrahedron)] ?? 1;
  return {
    minScaledJacobian: found.minScaledJacobian,
    meanScaledJacobian: found.meanScaledJacobian,
    histogram: [...found.histogram],
    worst: [...found.worst].map((tetrahedron) => ({ tetrahedron, scaledJacobian: valueOf(tetrahedron) })),
    movedNodes: found.movedNodes.length,
    straightened: Array.from({ length: straightened.length / 2 }, (_, edge) => {
      const [a = 0, b = 0] = straightened.subarray(2 * edge, 2 * edge + 2);
      const middle = (axis: number) => 0.5 * (points[3 * a + axis] ?? 0) + 0.5 * (points[3 * b + axis] ?? 0);
      return { nodes: [a, b], position: [middle(0), middle(1), middle(2)] };
    }),
  };
}

/** Says what the second-order elements of a mesh are like. */
export function secondOrderText(quality: SecondOrderQuality, { trueEdges }: Mesh): string {
  if (trueEdges === undefined) {
    return "second-order elements have straight edges, because the surface consists of triangles";
  }
  const { minScaledJacobian: min, meanScaledJacobian: mean, straightened } = quality;
  const shapes = `curved second-order elements, scaled Jacobian at least ${min.toFixed(3)}, mean ${mean.toFixed(3)}`;
  const [first] = straightened;
  if (first === undefined) return shapes;
  const [x, y, z] = first.position.map((value) => Number(value.toPrecision(6)));
  const were = straightened.length === 1 ? "edge was" : "edges were";
  const others = straightened.length === 1 ? "" : " and elsewhere";
  return `${shapes}; ${straightened.length} ${were} straightened, at (${x}, ${y}, ${z})${others}`;
}

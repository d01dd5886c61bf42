/** Places the nodes of a surface on the faces of the CAD file from which it was read. */
import { placedPoints, unplacedPoints } from "../base/placement.js";
import type { Steps } from "../base/steps.js";
import { inSteps } from "../calls/yielder.js";
import type { RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import { enclosedVolumes } from "../formats/sixfold-volume.js";
import { NO_REGION } from "../generated/constants.js";
import type { NodePlacement } from "../mesh/inspection.js";
import type { CurvedEdges, Mesh, PartialMesh, SurfaceInput, TrueFaces } from "../mesh/mesh.js";

export interface PlacedSurface {
  readonly mesh: Mesh;
  readonly placement: NodePlacement;
  /** What the surface encloses now, less what it enclosed before. */
  readonly volumeChange: number;
  /** Largest distance of the middle of an edge from the faces. */
  readonly bend: number;
}

/** Largest move of a node / deviation of a surface from the triangles of its file, which are near the true faces themselves. */
const REACH = 1.5;

/**
 * Returns a surface with its nodes on its true faces, and the edges that bend; undefined if it has none. `deviation`: of the
 * surface from the triangles of its file.
 */
export async function onTrueFaces(
  client: EngineClient,
  surface: Mesh,
  deviation: number,
  control: RunControl,
): Promise<PlacedSurface | undefined> {
  const { trueFaces, points, triangles, trianglePatch } = surface;
  if (trueFaces === undefined || trueFaces.length === 0) return undefined;
  const { placement } = trueFaces[0] ?? {};
  const scale = placement?.scale ?? 1;
  const given = unplacedPoints(points, placement);
  const { numbers, ...shown } = joined(trueFaces);
  const request = [
    given,
    triangles.slice(),
    trianglePatch.slice(),
    numbers,
    shown,
    (REACH * deviation) / scale,
  ] as const;
  const found = await client.ask("placeNodes", request, control);
  const stayed = new Set(found.unplaced);
  const onFaces = placedPoints(found.points, placement);
  const placed = Float64Array.from(points, (x, i) => (stayed.has(Math.floor(i / 3)) ? x : (onFaces[i] ?? 0)));
  const trueEdges = { edges: found.curvedEdges, middles: placedPoints(found.middles, placement) };
  const mesh = { ...surface, points: placed, trueEdges };
  const [before, after] = [await inSteps(volumeIn(surface)), await inSteps(volumeIn(mesh))];
  return {
    mesh,
    placement: {
      placed: found.placed,
      unplaced: found.unplaced.length,
      largestMove: found.largestMove * scale,
    },
    volumeChange: after - before,
    bend: bendOf(mesh),
  };
}

function bendOf({
  points,
  trueEdges: { edges, middles },
}: Pick<Mesh, "points"> & { readonly trueEdges: CurvedEdges }) {
  let largest = 0;
  for (let edge = 0; edge < edges.length / 2; ++edge) {
    const [a, b] = [3 * (edges[2 * edge] ?? 0), 3 * (edges[2 * edge + 1] ?? 0)];
    const offset = (k: number) =>
      (middles[3 * edge + k] ?? 0) - ((points[a + k] ?? 0) + (points[b + k] ?? 0)) / 2;
    largest = Math.max(largest, Math.hypot(offset(0), offset(1), offset(2)));
  }
  return largest;
}

/** Returns the numbers of the true faces for a remeshing; none if they were moved or scaled since they were read. */
export function modelNumbers(surface: SurfaceInput): Float64Array {
  return scaleOfFaces(surface) === 1 ? modelOf(surface).numbers : new Float64Array();
}

/**
 * Returns the factor by which all true faces of a mesh were scaled since they were read, 1 without faces; undefined if they were
 * moved, or scaled by different factors.
 */
export function scaleOfFaces({ trueFaces = [] }: PartialMesh): number | undefined {
  const scales = new Set(
    trueFaces.map(({ placement: { position, rotation, scale = 1 } = {} }) =>
      position === undefined && rotation === undefined ? scale : undefined,
    ),
  );
  return scales.size > 1 ? undefined : [...scales, 1][0];
}

/**
 * Returns the true faces of a mesh as the engine reads them, and the triangles near them, in new arrays and with the lengths of their
 * file; none without a `scaleOfFaces`.
 */
export function modelOf(mesh: PartialMesh): ReturnType<typeof joined> {
  return joined(scaleOfFaces(mesh) === undefined ? [] : (mesh.trueFaces ?? []));
}

/** Returns the faces of all solids as those of one, in new arrays: the engine's worker gets the arrays of a question. */
function joined(solids: readonly TrueFaces[]): Omit<TrueFaces, "faceCount" | "placement"> {
  const sum = (lengthOf: (solid: TrueFaces) => number) =>
    solids.reduce((all, solid) => all + lengthOf(solid), 0);
  const all = {
    numbers: new Float64Array(sum(({ numbers }) => numbers.length)),
    points: new Float64Array(sum(({ points }) => points.length)),
    parameters: new Float64Array(sum(({ parameters }) => parameters.length)),
    triangles: new Uint32Array(sum(({ triangles }) => triangles.length)),
    faces: new Uint32Array(sum(({ faces }) => faces.length)),
  };
  let [number, node, triangle, face] = [0, 0, 0, 0];
  for (const { numbers, points, parameters, triangles, faces, faceCount } of solids) {
    all.numbers.set(numbers, number);
    all.points.set(points, 3 * node);
    all.parameters.set(parameters, 2 * node);
    all.triangles.set(
      triangles.map((own) => own + node),
      3 * triangle,
    );
    all.faces.set(
      faces.map((own) => own + face),
      triangle,
    );
    number += numbers.length;
    node += points.length / 3;
    triangle += faces.length;
    face += faceCount;
  }
  return all;
}

/** Returns what the triangles enclose that do not lie between two regions. */
function* volumeIn(surface: Mesh): Steps<number> {
  const beside = surface.surfaceRegions?.triangleRegions;
  const isOuter = (triangle: number) => (beside?.[2 * triangle + 1] ?? NO_REGION) === NO_REGION;
  const [volume = 0] = yield* enclosedVolumes(surface, 1, (t) => (isOuter(t) ? 0 : undefined));
  return volume;
}

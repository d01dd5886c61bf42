/** Places the nodes of a surface on the faces of the CAD file from which it was read. */
import type { Steps } from "../base/steps.js";
import { inSteps } from "../calls/yielder.js";
import type { RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import { enclosedVolumes } from "../formats/sixfold-volume.js";
import { NO_REGION } from "../generated/constants.js";
import type { NodePlacement } from "../mesh/inspection.js";
import type { Mesh } from "../mesh/mesh.js";

export interface PlacedSurface {
  readonly mesh: Mesh;
  readonly placement: NodePlacement;
  /** What the surface encloses now, less what it enclosed before. */
  readonly volumeChange: number;
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
  if (trueFaces === undefined) return undefined;
  const { numbers, scale = 1, ...near } = trueFaces;
  // The engine's worker gets the arrays of a question, and the surface keeps its own.
  const shown = {
    points: near.points.slice(),
    parameters: near.parameters.slice(),
    triangles: near.triangles.slice(),
    faces: near.faces.slice(),
  };
  const given = points.map((x) => x / scale);
  const request = [
    given,
    triangles.slice(),
    trianglePatch.slice(),
    numbers.slice(),
    shown,
    (REACH * deviation) / scale,
  ] as const;
  const found = await client.ask("placeNodes", request, control);
  const stayed = new Set(found.unplaced);
  const placed = Float64Array.from(points, (x, i) =>
    stayed.has(Math.floor(i / 3)) ? x : (found.points[i] ?? 0) * scale,
  );
  const trueEdges = { edges: found.curvedEdges, middles: found.middles.map((x) => x * scale) };
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
  };
}

/** Returns what the triangles enclose that do not lie between two regions. */
function* volumeIn(surface: Mesh): Steps<number> {
  const beside = surface.surfaceRegions?.triangleRegions;
  const isOuter = (triangle: number) => (beside?.[2 * triangle + 1] ?? NO_REGION) === NO_REGION;
  const [volume = 0] = yield* enclosedVolumes(surface, 1, (t) => (isOuter(t) ? 0 : undefined));
  return volume;
}

/** Turns the points of a file that mark regions and holes into the regions on the sides of its triangles. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import type { EngineLocation } from "../engine/loader.js";
import { NO_REGION } from "../generated/constants.js";
import type { MeshGroup, Mesh, SurfaceInput, RegionPoint, RegionPoints } from "../mesh/mesh.js";
import { checkSurface } from "./input-checks.js";
import { completeSurface } from "./carried-mesh.js";
import { changeDiagnostics } from "./inspection.js";
import { chainedOrigins, surfaceNamer } from "./surface-numbers.js";

/** Result of `locateRegions`. */
export interface RegionLocation {
  /** The surface without the triangles between holes and the outside; all others face outward. */
  readonly mesh: Mesh;
  /** Warnings about points without effect. */
  readonly diagnostics: readonly Diagnostic[];
}

/** Implements `Mesher.locateRegions`. */
export async function locateRegions(
  client: EngineClient,
  surface: SurfaceInput,
  control: RunControl,
): Promise<RegionLocation> {
  refuse(checkSurface(surface));
  const { regionPoints = { holes: [], regions: [] } } = surface;
  const given = [surface.points.slice(), surface.triangles.slice(), positionsOf(regionPoints)] as const;
  const location = await client.ask("locateRegions", given, control);
  const isError = ({ severity }: Diagnostic) => severity === "error";
  refuse(changeDiagnostics(location, surfaceNamer(surface)).filter(isError));
  const found = volumesOf(regionPoints, location);
  refuse(found.diagnostics.filter(isError));
  return { mesh: locatedSurface(completeSurface(surface), location, found), diagnostics: found.diagnostics };
}

/** Values of `volumeOf` in the engine's answer. */
const OUTSIDE = 0xffffffff;
const ON_BOUNDARY = 0xfffffffe;

type AnyPoint = Pick<RegionPoint, "number" | "position">;

/** Returns x y z of all points: first those of holes, then those of regions. */
function positionsOf({ holes, regions }: RegionPoints): Float64Array {
  return Float64Array.from([...holes, ...regions].flatMap(({ position }) => position));
}

/** Errors prevent the use of the volumes: a point on the surface marks nothing, and something must be left to mesh. */
interface Volumes {
  /** Per enclosed volume: whether it is a hole. */
  readonly isHole: readonly boolean[];
  /** Per enclosed volume: its first region point. */
  readonly pointOf: readonly (RegionPoint | undefined)[];
  readonly diagnostics: readonly Diagnostic[];
}

function volumesOf({ holes, regions }: RegionPoints, { volumes, volumeOf }: EngineLocation): Volumes {
  const isHole = Array.from({ length: volumes }, () => false);
  const pointOf = Array.from({ length: volumes }, (): RegionPoint | undefined => undefined);
  const diagnostics: Diagnostic[] = [];
  const locate = (word: string, point: AnyPoint, volume = OUTSIDE): number | undefined => {
    if (volume < volumes) return volume;
    diagnostics.push(volume === ON_BOUNDARY ? onBoundary(word, point) : outside(word, point));
    return undefined;
  };
  holes.forEach((point, i) => {
    const volume = locate("hole", point, volumeOf[i]);
    if (volume !== undefined) isHole[volume] = true;
  });
  regions.forEach((point, i) => {
    const volume = locate("region", point, volumeOf[holes.length + i]);
    if (volume === undefined) return;
    const first = pointOf[volume];
    if (isHole[volume] === true) diagnostics.push(inHole(point));
    else if (first === undefined) pointOf[volume] = point;
    else diagnostics.push(inSameRegion(first, point));
  });
  if (volumes > 0 && isHole.every(Boolean)) diagnostics.push(nothingLeft());
  return { isHole, pointOf, diagnostics };
}

/** Returns the surface with its regions, by the engine's answer about it. */
function locatedSurface(given: Mesh, location: EngineLocation, found: Volumes): Mesh {
  const { isHole, pointOf } = found;
  const regionOf = isHole.map((): number => NO_REGION);
  const regions: MeshGroup[] = [];
  const maxVolumes: number[] = [];
  let lastTag = pointOf.reduce((last, point) => Math.max(last, Math.floor(point?.tag ?? 0)), 0);
  pointOf.forEach((point, volume) => {
    if (isHole[volume] === true) return;
    regionOf[volume] = regions.length;
    const tag = point?.tag ?? ++lastTag;
    regions.push({ name: point?.name ?? `region ${tag}`, tag });
    maxVolumes.push(point?.maxVolume ?? 0);
  });
  const kept = keptTriangles(location, regionOf);
  const { regionPoints: _, origin, nodeOrigin, points, ...rest } = given;
  const nodes = usedNodes(kept.triangles, points.length / 3);
  const of = (triangle: number) => given.trianglePatch[triangle] ?? 0;
  return {
    ...rest,
    points: Float64Array.from(nodes.used.flatMap((n) => [...points.subarray(3 * n, 3 * n + 3)])),
    triangles: kept.triangles.map((node) => nodes.indexOf[node] ?? 0),
    trianglePatch: Uint32Array.from(kept.origin, of),
    origin: chainedOrigins(origin, Uint32Array.from(kept.origin)),
    nodeOrigin: chainedOrigins(nodeOrigin, Uint32Array.from(nodes.used)),
    surfaceRegions: {
      regions,
      triangleRegions: kept.triangleRegions,
      areMeshed: true,
      maxVolumes: Float64Array.from(maxVolumes),
    },
  };
}

/** Omits triangles without a region on either side; flips those with a region in front only. */
function keptTriangles({ triangles, triangleRegions }: EngineLocation, regionOf: readonly number[]) {
  const kept: number[] = [];
  const regions: number[] = [];
  const origin: number[] = [];
  for (let t = 0; 3 * t < triangles.length; t++) {
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    const [back = NO_REGION, front = NO_REGION] = [0, 1].map(
      (side) => regionOf[triangleRegions[2 * t + side] ?? NO_REGION],
    );
    if (back === NO_REGION && front === NO_REGION) continue;
    const isFlipped = back === NO_REGION;
    kept.push(a, isFlipped ? c : b, isFlipped ? b : c);
    regions.push(isFlipped ? front : back, isFlipped ? back : front);
    origin.push(t);
  }
  return { triangles: Uint32Array.from(kept), triangleRegions: Uint32Array.from(regions), origin };
}

function usedNodes(triangles: Uint32Array, count: number) {
  const indexOf = new Uint32Array(count);
  for (const node of triangles) indexOf[node] = 1;
  const used: number[] = [];
  indexOf.forEach((isUsed, node) => {
    if (isUsed === 0) return;
    indexOf[node] = used.length;
    used.push(node);
  });
  return { used, indexOf };
}

const atText = ({ position }: AnyPoint) => `(${position.join(", ")})`;

function outside(word: string, point: AnyPoint): Diagnostic {
  const message = `${word} point ${point.number} at ${atText(point)} lies outside the surface and has no effect`;
  return packageDiagnostic(
    "region-point",
    message,
    "Move it into an enclosed volume, or remove it.",
    "warning",
  );
}

function onBoundary(word: string, point: AnyPoint): Diagnostic {
  const message = `${word} point ${point.number} at ${atText(point)} lies on the surface, so it marks no volume`;
  return packageDiagnostic("region-point", message, "Move it into the volume that it marks.");
}

function inHole(point: AnyPoint): Diagnostic {
  const message = `region point ${point.number} at ${atText(point)} lies in a hole and has no effect`;
  return packageDiagnostic("region-point", message, "Remove it, or the hole point.", "warning");
}

function inSameRegion(first: AnyPoint, point: AnyPoint): Diagnostic {
  const message = `region points ${first.number} and ${point.number} at ${atText(first)} and ${atText(point)} lie in the same region; the first one counts`;
  return packageDiagnostic("region-point", message, "Remove one of them.", "warning");
}

function nothingLeft(): Diagnostic {
  const message = "every volume that the surface encloses contains a hole point";
  return packageDiagnostic(
    "region-point",
    message,
    "Remove the hole point of a volume that is to be meshed.",
  );
}

import {
  base64Of,
  deviationOf,
  rowsOf,
  type FaceLook,
  type GridFace,
  type LoopCurve,
  type SewnFace,
} from "tetrafront/internal";
import type { Project, ProjectLine, ProjectPatch } from "tetrafront/project";
import { defaultName, operationStrings } from "../../strings";
import { arcThrough, circleThrough, type CircularArc } from "../arcs";
import { findRecord } from "../entities";
import { linePositions } from "../line-samples";
import type { Position } from "../position";
import { nextTurn } from "../slices";
import {
  add,
  addScaled,
  areaVector,
  boxOf,
  cross,
  distance,
  dot,
  frameAlong,
  length,
  scale,
  subtract,
  unit,
} from "../vectors";
import { plain, type Typed } from "./feature-numbers";
import type { DrawnSamples, SolidMaker } from "./operation";
import { drawnCurves, profileWithin } from "./solid-profiles";

const { refusals } = operationStrings;

/** Faces of a solid that follow drawn patches, or why one has none. */
export type FoundFaces =
  | {
      readonly faces: readonly Typed<SewnFace>[];
      readonly looks: readonly FaceLook[];
      /** The id of the patch of each face. */
      readonly owners: readonly number[];
    }
  | { readonly reason: string };

/** Rows and columns of positions per patch, tried one after the other, and at last. */
const refinements = [24, 48];
const finest = 96;
/** A face through positions is near its patch at this distance, as a part of the size of all; the kernel refuses the double. */
const near = 5e-5;
/** Lines of a plane patch may be this far from its plane, as a part of their size: half of what the kernel joins. */
const flat = 5e-6;
/** Lengths and angles that differ by less, as a part of the radius, are the same. */
const same = 1e-9;

/** Returns how sentences, and faces, name a drawn patch. */
const nameOf = ({ id, name }: ProjectPatch): string => name ?? defaultName("patch", id);

const isExactLine = ({ type, startTangent, endTangent }: ProjectLine): boolean =>
  (type === "straight" || type === "arc" || type === "circle") && !startTangent && !endTangent;

const linesOf = (project: Project, { loops }: ProjectPatch): readonly ProjectLine[] =>
  loops.flat().flatMap((step) => findRecord(project, "line", Math.abs(step)) ?? []);

/** Returns whether all patches are plane between straight lines and circles: their faces then follow the parameters of their points. */
export const arePlain = (project: Project, patches: readonly ProjectPatch[]): boolean =>
  patches.every((patch) => patch.type === "planar" && linesOf(project, patch).every(isExactLine));

/** Returns the faces of patches for which `arePlain`. */
export function plainFaces(project: Project, patches: readonly ProjectPatch[]): FoundFaces {
  const found = patches.map(({ loops }) => profileWithin(project, loops));
  const [refused] = found.flatMap((one) => (one.success ? [] : [one.reason]));
  if (refused !== undefined) return { reason: refused };
  return {
    faces: found.flatMap((one) => (one.success ? [one.profile] : [])),
    looks: patches.map((patch) => ({ name: nameOf(patch) })),
    owners: patches.map(({ id }) => id),
  };
}

/**
 * Returns the faces of patches of any kind, as they are drawn now: expressions do not change them. Patches whose faces would be too far
 * away get more positions.
 */
export async function sampledFaces(
  project: Project,
  patches: readonly ProjectPatch[],
  maker: Pick<SolidMaker, "samplesOf">,
): Promise<FoundFaces> {
  for (const cells of refinements) {
    const samples = await maker.samplesOf(project, cells);
    const found = facesOn(project, patches, samples);
    if ("reason" in found || (await areNear(found.faces, sizeOf(project, patches, samples)))) return found;
  }
  return facesOn(project, patches, await maker.samplesOf(project, finest));
}

/** Returns whether all faces through positions are near their patches; the page can do other things between them. `size`: of all. */
async function areNear(faces: readonly Typed<SewnFace>[], size: number): Promise<boolean> {
  for (const face of faces) {
    const rows = "grid" in face ? rowsOf(face) : undefined;
    if (rows !== undefined && deviationOf(rows) > near * size) return false;
    await nextTurn();
  }
  return true;
}

/** Returns the diagonal of the box around patches. */
function sizeOf(project: Project, patches: readonly ProjectPatch[], samples: DrawnSamples): number {
  const corners = patches.flatMap((patch) => {
    const { points } = shownOf(project, patch, samples);
    const { low, high } = boxOf(points);
    return points.length === 0 ? [] : [...low, ...high];
  });
  const { low, high } = boxOf(corners);
  return distance(low, high);
}

/** Returns the points of a patch, x y z each, and its triangles. */
function shownOf(project: Project, patch: ProjectPatch, { patches }: DrawnSamples) {
  const index = project.patches.indexOf(patch);
  const [from = 0, to = 0] = [patches.patchOffsets[index], patches.patchOffsets[index + 1]];
  const nodes = patches.triangles.subarray(3 * from, 3 * to);
  // The points of a patch follow each other.
  const first = nodes.reduce((lowest, node) => Math.min(lowest, node), nodes[0] ?? 0);
  const last = nodes.reduce((highest, node) => Math.max(highest, node), -1);
  return {
    points: patches.points.subarray(3 * first, 3 * (last + 1)),
    triangles: nodes.map((node) => node - first),
  };
}

function facesOn(project: Project, patches: readonly ProjectPatch[], samples: DrawnSamples): FoundFaces {
  // Without expressions, all numbers are plain.
  const plainProject = { ...project, expressions: [] };
  const drawn: Drawn = { project: plainProject, samples, sides: sidesOf(project, patches, samples) };
  const found = patches.map((patch) => facesOf(drawn, patch));
  const refused = found.find((one) => typeof one === "string");
  if (refused !== undefined) return { reason: refused };
  const all = found.flatMap((faces, p) => {
    const patch = patches[p];
    if (typeof faces === "string" || !patch) return [];
    return faces.map((face, f) => ({
      face,
      owner: patch.id,
      look: { name: faces.length > 1 ? `${nameOf(patch)} ${f + 1}` : nameOf(patch) },
    }));
  });
  return {
    faces: all.map(({ face }) => face),
    looks: all.map(({ look }) => look),
    owners: all.map(({ owner }) => owner),
  };
}

/** What is drawn, positions on it, and those on the sides of curved patches. */
interface Drawn {
  readonly project: Project;
  readonly samples: DrawnSamples;
  readonly sides: ReadonlyMap<number, readonly Position[]>;
}

function facesOf(drawn: Drawn, patch: ProjectPatch): readonly SewnFace[] | string {
  const { project, samples } = drawn;
  if (patch.type === "planar") return planeFace(drawn, patch);
  if (patch.type !== "tube" && patch.type !== "loft" && patch.loops.length > 1)
    return refusals.curvedHoles(nameOf(patch));
  const turned = patch.type === "tube" ? turnedTube(project, patch) : turnedStrip(project, patch);
  if (turned) return [turned];
  const grids = gridsOf(project, patch, samples);
  return grids.length > 0 ? grids : refusals.notEvaluated(nameOf(patch));
}

function planeFace(drawn: Drawn, patch: ProjectPatch): readonly SewnFace[] | string {
  const given = patch.loops.map((loop) => loop.flatMap((step) => sampledCurve(drawn, step) ?? []));
  const loops = flattened(given);
  if (!loops) return refusals.notInPlane(nameOf(patch));
  const [outer, ...holes] = loops;
  if (!outer || loops.some((loop, l) => loop.length !== patch.loops[l]?.length))
    return refusals.notEvaluated(nameOf(patch));
  return [{ outer, ...(holes.length > 0 && { holes }) }];
}

/** Returns positions of curves: of a circle, the centre and the ends of two radii. */
const positionsOf = (loop: readonly LoopCurve[]): readonly Position[] =>
  loop.flatMap((curve): readonly Position[] => {
    if ("points" in curve) return curve.points;
    const { x, y } = frameAlong(curve.axis);
    return [curve.center, ...[x, y].map((along) => addScaled(curve.center, along, curve.radius))];
  });

/** Returns loops moved into their plane: coordinates may be rounded. Null if they are farther from it than edges are joined. */
function flattened(loops: readonly (readonly LoopCurve[])[]): readonly (readonly LoopCurve[])[] | null {
  const positions = loops.flatMap(positionsOf);
  const [origin] = positions;
  const normal = unit(areaVector(positionsOf(loops[0] ?? [])));
  if (!origin || !normal) return loops;
  const heightOf = (position: Position): number => dot(subtract(position, origin), normal);
  const size = Math.max(...positions.map((position) => distance(position, origin)));
  if (positions.some((position) => Math.abs(heightOf(position)) > flat * size)) return null;
  const moved = (position: Position): Position => addScaled(position, normal, -heightOf(position));
  const movedCurve = (curve: LoopCurve): LoopCurve =>
    "points" in curve
      ? ({ ...curve, points: curve.points.map(moved) } as unknown as LoopCurve)
      : { ...curve, center: moved(curve.center), axis: signed(normal) };
  return loops.map((loop) => loop.map(movedCurve));
}

/** Returns a line as a curve of the kernel, other than arcs as a spline through samples; null if it cannot be evaluated. */
function sampledCurve({ project, samples, sides }: Drawn, step: number): LoopCurve | null {
  const line = findRecord(project, "line", Math.abs(step));
  if (!line) return null;
  if (isExactLine(line)) {
    const curve = drawnCurves(project, [[step]])?.[0]?.[0];
    return curve ? alongAxis(plain<LoopCurve>(curve)) : null;
  }
  const isClosed = line.points[0] === line.points.at(-1);
  const along = sides.get(line.id) ?? polylineOf(project, line, samples.lines);
  if (along.length < 2) return null;
  const points = step < 0 ? along.toReversed() : along;
  return isClosed
    ? { kind: "spline", points: points.slice(1), isClosed }
    : { kind: "spline", points, isEven: true };
}

/** Returns positions along a line, in its direction: the engine may have turned it. */
function polylineOf(project: Project, line: ProjectLine, { linePoints, lineOffsets }: DrawnSamples["lines"]) {
  const index = project.lines.findIndex(({ id }) => id === line.id);
  const along = positionsIn(
    linePoints.subarray(3 * (lineOffsets[index] ?? 0), 3 * (lineOffsets[index + 1] ?? 0)),
  );
  return isForward(project, line, along) ? along : along.toReversed();
}

function isForward(project: Project, line: ProjectLine, along: readonly Position[]): boolean {
  const [start] = linePositions(project, line);
  const [first, last] = [along[0], along.at(-1)];
  return !start || !first || !last || distance(start, first) <= distance(start, last);
}

/** Returns the positions along the sides of the lattices of patches, in the direction of each line. */
function sidesOf(
  project: Project,
  patches: readonly ProjectPatch[],
  samples: DrawnSamples,
): ReadonlyMap<number, readonly Position[]> {
  const found = new Map<number, readonly Position[]>();
  for (const patch of patches) {
    const hasHoles = patch.loops.length > 1 && patch.type !== "loft";
    if (patch.type === "planar" || patch.type === "tube" || hasHoles) continue;
    const [grid] = gridsOf(project, patch, samples);
    const rows = grid && rowsOf(grid);
    if (!rows) continue;
    const along = (column: number): Position[] => rows.flatMap((row) => row.slice(column).slice(0, 1));
    const [bottom = [], top = []] = [rows[0], rows.at(-1)?.toReversed()];
    const isTriangle = patch.loops[0]?.length === 3;
    const sides = [bottom, along(-1), ...(isTriangle ? [] : [top]), along(0).toReversed()];
    patch.loops[0]?.forEach((step, s) => {
      const side = sides[s] ?? [];
      found.set(Math.abs(step), step < 0 ? side.toReversed() : side);
    });
  }
  return found;
}

const positionsIn = (numbers: Float64Array): Position[] =>
  Array.from({ length: numbers.length / 3 }, (_, i) => [
    numbers[3 * i] ?? 0,
    numbers[3 * i + 1] ?? 0,
    numbers[3 * i + 2] ?? 0,
  ]);

/** Returns a direction or the opposite one: the same for both. The kernel begins circles about the same axis at the same angle. */
function signed(axis: Position): Position {
  const largest = axis.reduce((best, part) => (Math.abs(part) > Math.abs(best) ? part : best), 0);
  return largest < 0 ? scale(axis, -1) : axis;
}

const alongAxis = (curve: LoopCurve): LoopCurve =>
  curve.kind === "circle" ? { ...curve, axis: signed(curve.axis) } : curve;

const radiusOf = ({ start, centre }: CircularArc): number => distance(start, centre);

function areCoaxial(one: CircularArc, other: CircularArc): boolean {
  const [between, size] = [subtract(other.centre, one.centre), radiusOf(one) + radiusOf(other)];
  return length(cross(one.normal, other.normal)) <= same && length(cross(one.normal, between)) <= same * size;
}

/** Returns the cylinder, cone or ring between two circles about one axis. */
function turnedTube(project: Project, { loops }: ProjectPatch): SewnFace | null {
  const [one, other, ...more] = loops.map((loop) => (loop.length === 1 ? circleOf(project, loop[0]) : null));
  if (!one || !other || more.length > 0 || !areCoaxial(one, other)) return null;
  const radius = scale(subtract(one.start, one.centre), radiusOf(other) / radiusOf(one));
  const points = [one.start, add(other.centre, radius)] as const;
  return { curve: { kind: "line", points }, position: one.centre, axis: signed(one.normal), angle: 360 };
}

function circleOf(project: Project, step = 0): CircularArc | null {
  const line = findRecord(project, "line", Math.abs(step));
  const [a, b, c] = line ? linePositions(project, line) : [];
  return line?.type === "circle" && a && b && c ? circleThrough(a, b, c) : null;
}

/** Returns the face between two straight lines and two arcs about one axis, of the same angle: a straight line, turned. */
function turnedStrip(project: Project, { type, loops }: ProjectPatch): SewnFace | null {
  const loop = loops[0] ?? [];
  if (type !== "coons" && type !== "loft") return null;
  if (loops.length !== 1 || loop.length !== 4) return null;
  const courses = loop.map((step) => courseOf(project, step));
  const first = courses.findIndex((course, k) => course?.arc === null && courses[(k + 1) % 4]?.arc);
  const [line, near, opposite, far] = [0, 1, 2, 3].map((k) => courses[(first + k) % 4]);
  if (first < 0 || !line || !near?.arc || opposite?.arc !== null || !far?.arc) return null;
  const [arc, back] = [near.arc, far.arc];
  const isSameTurn = dot(arc.normal, back.normal) < 0 && Math.abs(arc.angle - back.angle) <= same;
  if (!areCoaxial(arc, back) || !isSameTurn) return null;
  const points = [line.start, line.end] as const;
  const angle = (arc.angle * 180) / Math.PI;
  return { curve: { kind: "line", points }, position: arc.centre, axis: arc.normal, angle };
}

/** Returns a straight line, or an arc, in the direction of a loop; null for other lines. */
function courseOf(project: Project, step: number) {
  const line = findRecord(project, "line", Math.abs(step));
  if (!line) return null;
  const along = linePositions(project, line);
  const [a, b, c] = step < 0 ? along.toReversed() : along;
  if (line.type === "straight") return a && b ? { start: a, end: b, arc: null } : null;
  if (line.type !== "arc" || !a || !b || !c) return null;
  const arc = arcThrough(a, b, c);
  return arc && { start: a, end: c, arc };
}

/** Returns the lattices of a patch, one after the other: a tube has several. */
function gridsOf(project: Project, patch: ProjectPatch, samples: DrawnSamples): GridFace[] {
  const { points, triangles } = shownOf(project, patch, samples);
  // The third corner of the first triangle is the first position of the second row.
  const [, , perRow] = triangles;
  if (perRow === undefined) return [];
  const isTriangle = patch.type !== "tube" && patch.loops[0]?.length === 3;
  const perGrid = isTriangle ? points.length / 3 : perRow ** 2;
  return Array.from({ length: Math.floor(points.length / (3 * perGrid)) }, (_, g) => {
    const numbers = points.slice(3 * g * perGrid, 3 * (g + 1) * perGrid);
    return { grid: isTriangle ? "triangle" : "square", positions: base64Of(new Uint8Array(numbers.buffer)) };
  });
}

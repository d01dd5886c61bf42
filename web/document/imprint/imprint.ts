import type { Project, ProjectPatch } from "tetrafront/project";
import { coincidenceLength, freeName } from "../insert-shape";
import type { LinePath } from "../line-paths";
import { changedLists } from "../splits/split-line";
import { loopPolygon, samplesAlong } from "../line-samples";
import { facesInPlane, type Flat, type PlaneFace } from "../planar-loops";
import type { Position } from "../position";
import {
  areaVector,
  cross,
  dot,
  frameAlong,
  length,
  scale,
  toFrame,
  unit,
  zero,
  type Frame,
} from "../vectors";
import { innerPlace, isWithin, overlap, type Polygons } from "./plane-polygons";
import { dividedInPlane } from "./divide-lines";

/** The lists of a project that imprinting changes. */
type Drawn = Pick<Project, "points" | "lines" | "patches" | "groups" | "expressions">;

/** What imprinting gives. */
export interface Imprint {
  /** The lists that change. */
  readonly drawn: Partial<Drawn>;
  /** Number of faces that now belong to patches before and to added ones. */
  readonly shared: number;
  /** Whether faces overlap that could not be divided: lines touch without crossing, or a patch needs its lines. */
  readonly isIncomplete: boolean;
  /** The patches that lie where each added patch was. */
  readonly patches: ReadonlyMap<number, readonly number[]>;
}

/** What imprinting has given so far. */
interface State extends Omit<Imprint, "drawn"> {
  readonly project: Project;
}

/** Tolerances relative to that of coincident points: of planes, and of points on lines. */
const planeFactor = 100;
const lineFactor = 10;
/** Normals are parallel if the sine of their angle is at most this. */
const parallelSine = 1e-7;

/** A planar patch with its plane and its box. */
interface Face {
  readonly patch: ProjectPatch;
  readonly normal: Position;
  readonly offset: number;
  readonly low: Position;
  readonly high: Position;
}

/**
 * Makes added planar patches and those of the project share the faces where they overlap: both are divided along each
 * other's lines, so that the surface is watertight there and separates two regions. Faces whose lines cannot be divided so
 * stay as they are. O(patches · added patches + lines² per plane).
 */
export function imprinted(project: Project, added: ReadonlySet<number>): Imprint {
  const { patches } = project;
  const tolerance = coincidenceLength(project);
  const faces = patches.flatMap((patch) => faceOf(project, patch) ?? []);
  const news = faces.filter(({ patch }) => added.has(patch.id));
  const olds = faces.filter(
    (face) => !added.has(face.patch.id) && news.some((other) => isBeside(face, other, tolerance)),
  );
  let state: State = {
    project,
    shared: 0,
    isIncomplete: false,
    patches: new Map([...added].map((id) => [id, [id]])),
  };
  const done = new Set<Face>();
  for (const face of news) {
    if (done.has(face)) continue;
    const inPlane = (other: Face): boolean => isBeside(face, other, Infinity);
    const besides = olds.filter((old) => inPlane(old));
    const own = news.filter(inPlane);
    for (const one of own) done.add(one);
    if (besides.length === 0) continue;
    const frame = frameAlong(face.normal, scale(face.normal, face.offset));
    state = imprintInPlane(project, state, frame, own, besides, tolerance);
  }
  const { project: last, ...imprint } = state;
  return { ...imprint, drawn: changedLists(project, last) };

  function isBeside(a: Face, b: Face, margin: number): boolean {
    const isParallel = length(cross(a.normal, b.normal)) <= parallelSine;
    const offset = dot(a.normal, b.normal) < 0 ? -b.offset : b.offset;
    if (!isParallel || Math.abs(a.offset - offset) > planeFactor * tolerance) return false;
    return a.low.every(
      (x, k) => x <= (b.high[k] ?? 0) + margin && (b.low[k] ?? 0) <= (a.high[k] ?? 0) + margin,
    );
  }
}

function faceOf(project: Project, patch: ProjectPatch): Face | null {
  if (patch.type !== "planar") return null;
  const polygon = loopPolygon(project, patch.loops[0] ?? []);
  const normal = unit(areaVector(polygon));
  const [corner] = polygon;
  if (!normal || !corner) return null;
  const bound = (choose: (...values: number[]) => number): Position => [
    polygon.reduce((best, [x]) => choose(best, x), corner[0]),
    polygon.reduce((best, [, y]) => choose(best, y), corner[1]),
    polygon.reduce((best, [, , z]) => choose(best, z), corner[2]),
  ];
  return { patch, normal, offset: dot(normal, corner), low: bound(Math.min), high: bound(Math.max) };
}

function imprintInPlane(
  project: Project,
  state: State,
  frame: Frame,
  news: readonly Face[],
  olds: readonly Face[],
  tolerance: number,
): State {
  const all = [...olds, ...news].map((face) => ({
    ...face,
    polygons: polygonsOf(project, face.patch, frame),
  }));
  const members = new Set(all.map(({ patch }) => patch.id));
  const linesOf = (drawn: Project) =>
    new Set(drawn.patches.flatMap(({ id, loops }) => (members.has(id) ? loops.flat().map(Math.abs) : [])));
  const areOverlapping = (): boolean =>
    all
      .slice(0, olds.length)
      .some((old) => all.slice(olds.length).some((added) => overlap(old.polygons, added.polygons)));
  const refused = (): State => (areOverlapping() ? { ...state, isIncomplete: true } : state);
  const split = dividedInPlane(state.project, linesOf, frame, lineFactor * tolerance);
  if (!split) return refused();
  const faces = facesInPlane(pathsOf(split, linesOf(split)), frame, planeFactor * tolerance);
  if (faces.some(({ isPinched }) => isPinched)) return refused();
  const newIds = new Set(news.map(({ patch }) => patch.id));
  const covered = faces.map((face) => {
    const inner = innerPlace(face.polygons);
    const patches = all.filter(({ polygons }) => inner && isWithin(inner, polygons));
    return {
      face,
      old: patches.find(({ patch }) => !newIds.has(patch.id)),
      added: patches.find(({ patch }) => newIds.has(patch.id)),
    };
  });
  const shared = covered.filter(({ old, added }) => old && added);
  if (shared.length === 0) return state;
  // A patch that is covered as a whole stays; otherwise the common face belongs to what was added.
  const hasOwn = new Set(covered.flatMap(({ old, added }) => (old && !added ? [old.patch.id] : [])));
  const facesOf = new Map<number, PlaneFace[]>();
  const addedFaces = new Map<number, PlaneFace[]>([...newIds].map((id) => [id, []]));
  for (const { face, old, added } of covered) {
    const owner = old && added ? (hasOwn.has(old.patch.id) ? added : old) : (old ?? added);
    if (!owner) continue;
    facesOf.set(owner.patch.id, [...(facesOf.get(owner.patch.id) ?? []), face]);
    if (added) addedFaces.get(added.patch.id)?.push(face);
  }
  const normals = new Map(all.map(({ patch, normal }) => [patch.id, normal]));
  const names = new Set(split.patches.flatMap(({ name }) => name ?? []));
  let next = split.patches.reduce((highest, { id }) => Math.max(highest, id), 0) + 1;
  const idsOfFaces = new Map<PlaneFace, number>();
  const patches = split.patches.flatMap((patch): ProjectPatch[] => {
    if (!members.has(patch.id)) return [patch];
    const isFlipped = dot(normals.get(patch.id) ?? zero, frame.z) < 0;
    const own = (facesOf.get(patch.id) ?? []).toSorted((a, b) => b.area - a.area);
    return own.map((face, i) => {
      const id = i === 0 ? patch.id : next++;
      idsOfFaces.set(face, id);
      const name = i === 0 || patch.name === undefined ? patch.name : freeName(patch.name, names);
      return { ...patch, id, ...(name !== undefined && { name }), loops: loopsOf(face, isFlipped) };
    });
  });
  const where = new Map(state.patches);
  for (const [id, own] of addedFaces)
    where.set(
      id,
      own.flatMap((face) => idsOfFaces.get(face) ?? []),
    );
  return { ...state, project: { ...split, patches }, shared: state.shared + shared.length, patches: where };
}

const loopsOf = ({ loops }: PlaneFace, isFlipped: boolean): number[][] =>
  loops.map((loop) => (isFlipped ? loop.toReversed().map((step) => -step) : [...loop]));

function pathsOf({ points, lines }: Project, ids: ReadonlySet<number>): readonly LinePath[] {
  const positions = new Map(points.map(({ id, position }) => [id, position]));
  return lines
    .filter(({ id }) => ids.has(id))
    .map((line) => ({
      line,
      positions: samplesAlong(
        line.type,
        line.points.map((id) => positions.get(id) ?? zero),
      ),
    }));
}

const polygonsOf = (project: Project, { loops }: ProjectPatch, frame: Frame): Polygons =>
  loops.map((loop) =>
    loopPolygon(project, loop).map((position): Flat => {
      const [x, y] = toFrame(frame, position);
      return [x, y];
    }),
  );

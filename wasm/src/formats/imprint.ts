/**
 * Gives faces on which shapes touch the same triangles, also where they overlap only in parts: a bolt is longer than the hole
 * around it. Curves of all shapes on a plane, cylinder, cone or sphere are drawn into its plane of coordinates, where one
 * triangulation serves all faces on it. Each shape stays closed.
 */
import { PAUSE, type Steps } from "../base/steps.js";
import { cornersOf, cross, dot, lengthOf, minus, type Vector } from "../base/vectors.js";
import { unifyCurves } from "./common-curves.js";
import { CrossingConstraints } from "./constrained-triangulation.js";
import { type FaceGroup, faceGroups, facesOutward } from "./face-groups.js";
import type { FittedSurface } from "./fitted-surface.js";
import { GrowingNodes } from "./growing-nodes.js";
import type { JoinedShapes } from "./joined-shapes.js";
import { diagonalOf } from "./near-points.js";
import { withoutPressFits } from "./press-fits.js";
import { directedKey, type FacesAndRims, facesAndRims, pairKey, type Rim, type ShapeRange } from "./rims.js";
import { type OpenedSurface, openedSurface } from "./sphere-pole.js";
import { hasBalls, withSeatedBalls } from "./seated-balls.js";
import { type Segment, type Split, trianglesWithin, UnrolledGroup } from "./unrolled-group.js";

/** Distance of faces that touch, relative to the diagonal: above the rounding of files, far below any clearance. */
const TOUCHING = 5e-7;

/** Largest change of the volume of a shape that new triangles of its curved faces may cause. */
const VOLUME_CHANGE = 0.02;

/** Returns the shapes with common triangles where they touch; the given ones if there are none. */
export function* imprinted(given: JoinedShapes): Steps<JoinedShapes> {
  const tolerance = TOUCHING * diagonalOf(given.points);
  const found = yield* facesAndRims(given, tolerance);
  const moved = yield* withoutPressFits(given, found, tolerance);
  if (moved === undefined) return yield* seated(yield* imprintedFaces(given, found, tolerance), tolerance);
  const made = yield* imprintedFaces(moved, yield* facesAndRims(moved, tolerance), tolerance);
  const isKept = keepsShapes(given, made);
  return yield* seated(isKept ? made : yield* imprintedFaces(given, found, tolerance), tolerance);
}

/** Gives balls the triangles of their seats, which have those that they share with other shapes. */
function* seated(joined: JoinedShapes, tolerance: number): Steps<JoinedShapes> {
  if (!hasBalls(joined, tolerance)) return joined;
  const made = yield* withSeatedBalls(joined, yield* facesAndRims(joined, tolerance), tolerance);
  return made !== joined && keepsShapes(joined, made)
    ? withoutUnused({ ...made, points: made.points.slice() })
    : joined;
}

function* imprintedFaces(joined: JoinedShapes, found: FacesAndRims, tolerance: number): Steps<JoinedShapes> {
  const given = found.rims.map(({ nodes }) => nodes);
  let groups = yield* faceGroups(joined, found, tolerance);
  while (groups.length > 0) {
    found.rims.forEach((rim, r) => (rim.nodes = given[r] ?? []));
    const imprint = new Imprint(joined, found, tolerance);
    const failed = yield* imprint.join(groups);
    if (failed === undefined) {
      const made = imprint.result(given);
      return made !== undefined && keepsShapes(joined, made) ? made : joined;
    }
    const left = groups.filter((group) => !isBeside(group, failed, found.faces));
    if (left.length === groups.length) return joined;
    groups = left;
  }
  return joined;
}

/** Returns whether a group has one of the faces, or one with a rim in common. */
function isBeside(group: FaceGroup, failed: FaceGroup, faces: readonly ShapeRange[]): boolean {
  const rims = new Set(failed.flatMap((f) => faces[f]?.rims ?? []));
  return group.some(
    (f) => failed.includes(f) || (failed.length === 1 && (faces[f]?.rims ?? []).some((r) => rims.has(r))),
  );
}

/** Faces that get one triangulation. */
interface Unit {
  readonly faces: FaceGroup;
  readonly surface: FittedSurface;
  readonly plane: UnrolledGroup;
  /** Node around which the plane has a hole. */
  readonly pole: number | undefined;
}

/** Rounds after which segments still meet only because of rounding. */
const MAX_ROUNDS = 8;

class Imprint {
  readonly #joined: JoinedShapes;
  readonly #found: FacesAndRims;
  readonly #tolerance: number;
  readonly #nodes: GrowingNodes;
  /** Rims that contain an edge. */
  readonly #users = new Map<number, Set<number>>();
  readonly #changed = new Set<number>();
  /** Per face: its new triangles. */
  readonly #made = new Map<number, Uint32Array>();

  constructor(joined: JoinedShapes, found: FacesAndRims, tolerance: number) {
    this.#joined = joined;
    this.#found = found;
    this.#tolerance = tolerance;
    this.#nodes = new GrowingNodes(joined.points, tolerance);
  }

  /** Makes the triangles of all groups and of the faces beside them. Returns the faces for which this failed, if any. */
  *join(groups: readonly FaceGroup[]): Steps<FaceGroup | undefined> {
    const { rims } = this.#found;
    const before = rims.map(({ nodes }) => nodes);
    yield* unifyCurves(this.#found, this.#joined.points, this.#tolerance);
    for (const [r, rim] of rims.entries()) {
      this.#use(r, rim);
      if (rim.nodes !== before[r]) this.#changed.add(r);
    }
    const units: Unit[] = [];
    for (const group of groups) {
      const unit = this.#unitOf(group);
      if (unit === undefined) return group;
      units.push(unit);
      if (!(yield* this.#drawAll(unit))) return group;
    }
    yield* this.#addTouched(units, new Set(groups.flat()));
    for (const unit of units) {
      if (!this.#triangulate(unit)) return unit.faces;
      yield PAUSE;
    }
    return undefined;
  }

  #unitOf(faces: FaceGroup): Unit | undefined {
    const own = this.#found.faces[faces[0] ?? 0]?.surface;
    if (own === undefined) return undefined;
    const { surface, pole } = this.#opened(own, faces);
    const options = { segments: this.#segmentsOf(faces), tolerance: this.#tolerance };
    const plane = new UnrolledGroup(surface, this.#nodes, options);
    this.#split(plane.splitsAtCut(options.segments));
    return { faces, surface, plane, pole };
  }

  #opened(surface: FittedSurface, faces: FaceGroup): OpenedSurface {
    if (surface.kind !== "sphere") return { surface };
    const triangles = faces.flatMap((f) => {
      const { begin = 0, end = 0 } = this.#found.faces[f] ?? {};
      return [...this.#joined.triangles.subarray(3 * begin, 3 * end)];
    });
    const positionOf = (node: number) => this.#nodes.positionOf(node);
    return openedSurface(surface, {
      positionOf,
      triangles,
      rimNodes: new Set(this.#segmentsOf(faces).flat()),
    });
  }

  /** Adds the nodes where the rims of the faces meet. Returns whether all were found. */
  *#drawAll({ faces, plane }: Unit): Steps<boolean> {
    for (let round = 0; round < MAX_ROUNDS; round++) {
      const splits = plane.crossings(this.#segmentsOf(faces));
      if (splits.length === 0) return true;
      this.#split(splits);
      yield PAUSE;
    }
    return false;
  }

  /** Adds a unit for each other face with changed rims; to open a closed face may change more. */
  *#addTouched(units: Unit[], isKnown: Set<number>): Steps<void> {
    const { rims, faces } = this.#found;
    for (const r of this.#changed) {
      for (const f of rims[r]?.faces ?? []) {
        if (isKnown.has(f) || faces[f]?.surface === undefined) continue;
        isKnown.add(f);
        const unit = this.#unitOf([f]);
        if (unit !== undefined) units.push(unit);
        yield PAUSE;
      }
    }
  }

  #use(r: number, { nodes }: Rim): void {
    for (const [a, b] of segmentsAlong(nodes)) {
      const key = pairKey(a, b);
      const users = this.#users.get(key);
      if (users === undefined) this.#users.set(key, new Set([r]));
      else users.add(r);
    }
  }

  #segmentsOf(faces: FaceGroup): Segment[] {
    const segments = new Map<number, Segment>();
    for (const f of faces) {
      for (const r of this.#found.faces[f]?.rims ?? []) {
        for (const segment of segmentsAlong(this.#found.rims[r]?.nodes ?? [])) {
          const key = pairKey(...segment);
          if (!segments.has(key)) segments.set(key, segment);
        }
      }
    }
    return [...segments.values()];
  }

  /** Inserts nodes into all rims with a segment. */
  #split(splits: readonly Split[]): void {
    const inner = new Map<number, Set<number>>();
    for (const { segment, node } of splits) {
      const key = pairKey(...segment);
      const known = inner.get(key);
      if (known === undefined) inner.set(key, new Set([node]));
      else known.add(node);
    }
    const touched = new Set([...inner.keys()].flatMap((key) => [...(this.#users.get(key) ?? [])]));
    for (const r of touched) {
      const rim = this.#found.rims[r];
      if (rim === undefined) continue;
      const nodes = [rim.nodes[0] ?? 0];
      for (const [a, b] of segmentsAlong(rim.nodes)) {
        const between = [...(inner.get(pairKey(a, b)) ?? [])];
        nodes.push(...this.#sortedFrom(a, between), b);
      }
      rim.nodes = nodes;
      this.#use(r, rim);
      this.#changed.add(r);
    }
  }

  #sortedFrom(node: number, others: readonly number[]): number[] {
    const origin = this.#nodes.positionOf(node);
    const distance = (other: number) => lengthOf(minus(this.#nodes.positionOf(other), origin));
    return others.toSorted((a, b) => distance(a) - distance(b) || a - b);
  }

  #triangulate({ faces, plane, surface, pole }: Unit): boolean {
    try {
      const inPlane = plane.triangles(this.#segmentsOf(faces), this.#innerNodes(faces, surface, pole));
      const all = pole === undefined ? inPlane : withFan(inPlane, pole);
      for (const f of faces) {
        const isForward = facesOutward(this.#joined, { begin: this.#found.faces[f]?.begin ?? 0, surface });
        const own = trianglesWithin(all, this.#borderOf(f, isForward));
        const corners = own.flatMap((t) => {
          const [a = 0, b = 0, c = 0] = all.subarray(3 * t, 3 * t + 3);
          return isForward ? [a, b, c] : [a, c, b];
        });
        this.#made.set(f, Uint32Array.from(corners));
      }
      return true;
    } catch (failure) {
      if (failure instanceof CrossingConstraints) return false;
      throw failure;
    }
  }

  #borderOf(f: number, isForward: boolean): Segment[] {
    return (this.#found.faces[f]?.rims ?? []).flatMap((r) => {
      const rim = this.#found.rims[r];
      if (rim === undefined) return [];
      const isAlong = (rim.faces[0] === f) === isForward;
      return segmentsAlong(isAlong ? rim.nodes : rim.nodes.toReversed());
    });
  }

  /** Returns nodes inside the faces, which only spheres need: elsewhere, the nodes of the rims suffice. */
  #innerNodes(faces: FaceGroup, { kind }: FittedSurface, pole: number | undefined): number[] {
    if (kind !== "sphere") return [];
    const spacing = SPACING * this.#meanEdge(faces);
    const rimNodes = new Set(this.#segmentsOf(faces).flat());
    const kept = new GrowingNodes(new Float64Array(), spacing);
    for (const node of rimNodes) kept.add(this.#nodes.positionOf(node));
    if (pole !== undefined) kept.add(this.#nodes.positionOf(pole));
    const inner: number[] = [];
    for (const f of faces) {
      const { begin = 0, end = 0 } = this.#found.faces[f] ?? {};
      for (const node of new Set(this.#joined.triangles.subarray(3 * begin, 3 * end))) {
        if (rimNodes.has(node) || this.#isOnOldRim(f, node)) continue;
        const count = kept.count;
        kept.add(this.#nodes.positionOf(node));
        if (kept.count > count) inner.push(node);
      }
    }
    return inner;
  }

  #isOnOldRim(f: number, node: number): boolean {
    return this.#oldRimNodes(f).has(node);
  }

  readonly #old = new Map<number, Set<number>>();

  /** Returns the nodes of a face that other faces of its shape have too. */
  #oldRimNodes(f: number): Set<number> {
    const known = this.#old.get(f);
    if (known !== undefined) return known;
    const { triangles, faceOf } = this.#joined;
    const own = this.#found.faces[f];
    const inside = new Set(triangles.subarray(3 * (own?.begin ?? 0), 3 * (own?.end ?? 0)));
    const common = new Set<number>();
    for (const other of this.#found.faces) {
      if (other.shape !== own?.shape || faceOf[other.begin] === faceOf[own.begin]) continue;
      for (const node of triangles.subarray(3 * other.begin, 3 * other.end))
        if (inside.has(node)) common.add(node);
    }
    this.#old.set(f, common);
    return common;
  }

  #meanEdge(faces: FaceGroup): number {
    let [sum, count] = [0, 0];
    for (const f of faces) {
      const { begin = 0, end = 0 } = this.#found.faces[f] ?? {};
      for (let t = begin; t < end; t++) {
        const [a, b] = cornersOf(this.#joined, t);
        sum += lengthOf(minus(b, a));
        count++;
      }
    }
    return sum / Math.max(count, 1);
  }

  /** Returns all shapes with their new triangles. `given`: the nodes of the rims before. */
  result(given: readonly (readonly number[])[]): JoinedShapes | undefined {
    const { triangles, shapeOf, faceOf, isDropped } = this.#joined;
    this.#splitOthers(given);
    const madeAt = new Map(
      [...this.#made].map(([f, made]) => [this.#found.faces[f]?.begin ?? 0, { f, made }]),
    );
    const corners: number[] = [];
    const shapes: number[] = [];
    const owners: number[] = [];
    for (let t = 0; t < shapeOf.length;) {
      const own = madeAt.get(t);
      const end = own === undefined ? t + 1 : (this.#found.faces[own.f]?.end ?? t + 1);
      const added =
        own === undefined ? (isDropped[t] === 1 ? [] : triangles.subarray(3 * t, 3 * t + 3)) : own.made;
      for (const node of added) corners.push(node);
      for (let i = 0; i < added.length / 3; i++) {
        shapes.push(shapeOf[t] ?? 0);
        owners.push(faceOf[t] ?? 0);
      }
      t = end;
    }
    return withoutUnused({
      ...this.#joined,
      points: this.#nodes.all(),
      triangles: Uint32Array.from(corners),
      shapeOf: Uint32Array.from(shapes),
      faceOf: Uint32Array.from(owners),
      twin: Uint32Array.from(shapes.keys()),
      isDropped: new Uint8Array(shapes.length),
    });
  }

  /** Divides the triangles of faces whose surface is not known at the nodes that their rims got. */
  #splitOthers(given: readonly (readonly number[])[]): void {
    const { rims, faces } = this.#found;
    const touched = new Set([...this.#changed].flatMap((r) => [...(rims[r]?.faces ?? [])]));
    for (const f of touched) {
      const face = faces[f];
      if (face === undefined || face.surface !== undefined) continue;
      const inner = new Map<number, number[]>();
      for (const r of face.rims) addInserted(inner, given[r] ?? [], rims[r]?.nodes ?? []);
      const corners = this.#joined.triangles.subarray(3 * face.begin, 3 * face.end);
      const made: number[] = [];
      for (let t = 0; t < corners.length; t += 3) {
        const [a = 0, b = 0, c = 0] = corners.subarray(t, t + 3);
        if (this.#joined.isDropped[face.begin + t / 3] === 0) divide([a, b, c], inner, made);
      }
      this.#made.set(f, Uint32Array.from(made));
    }
  }
}

/** Distance of inner nodes / mean length of edges, below which one of two is left out. */
const SPACING = 0.5;

/** Returns triangles of a sphere without its pole, and those around the pole. */
function withFan(triangles: Uint32Array, pole: number): Uint32Array {
  const edges = new Map<number, Segment>();
  triangles.forEach((a, corner) => {
    const b = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    if (!edges.delete(directedKey(b, a))) edges.set(directedKey(a, b), [a, b]);
  });
  return Uint32Array.from([...triangles, ...[...edges.values()].flatMap(([a, b]) => [b, a, pole])]);
}

const segmentsAlong = (nodes: readonly number[]): Segment[] =>
  nodes.slice(1).map((node, i) => [nodes[i] ?? 0, node]);

/** Adds the nodes that were inserted between two consecutive ones, by the key of their direction. */
function addInserted(
  inner: Map<number, number[]>,
  before: readonly number[],
  after: readonly number[],
): void {
  let at = 0;
  for (const [a, b] of segmentsAlong(before)) {
    const between: number[] = [];
    for (at++; at < after.length && after[at] !== b; at++) between.push(after[at] ?? 0);
    if (between.length === 0) continue;
    inner.set(directedKey(a, b), between);
    inner.set(directedKey(b, a), between.toReversed());
  }
}

/** Divides a triangle at the nodes inserted into its edges. */
function divide(
  corners: readonly [number, number, number],
  inner: Map<number, number[]>,
  made: number[],
): void {
  for (let k = 0; k < 3; k++) {
    const [a = 0, b = 0, c = 0] = [0, 1, 2].map((i) => corners[(k + i) % 3]);
    const between = inner.get(directedKey(a, b)) ?? [];
    const node = between[Math.floor(between.length / 2)];
    if (node === undefined) continue;
    const i = between.indexOf(node);
    inner.set(directedKey(a, node), between.slice(0, i));
    inner.set(directedKey(node, b), between.slice(i + 1));
    divide([a, node, c], inner, made);
    divide([node, b, c], inner, made);
    return;
  }
  made.push(...corners);
}

function withoutUnused(joined: JoinedShapes): JoinedShapes {
  const { triangles, points } = joined;
  const numberOf = new Uint32Array(points.length / 3);
  for (const node of triangles) numberOf[node] = 1;
  let count = 0;
  numberOf.forEach((isUsed, node) => {
    if (isUsed === 0) return;
    points.copyWithin(3 * count, 3 * node, 3 * node + 3);
    numberOf[node] = count++;
  });
  return {
    ...joined,
    points: points.slice(0, 3 * count),
    triangles: triangles.map((node) => numberOf[node] ?? 0),
  };
}

/** Returns whether all shapes that were closed still are, with about their volumes. */
function keepsShapes(before: JoinedShapes, after: JoinedShapes): boolean {
  const [old, made] = [before, after].map(shapesOf);
  return (old ?? []).every(({ volume, isClosed }, s) => {
    const now = made?.[s];
    if (now === undefined || !isClosed) return now !== undefined;
    return now.isClosed && Math.abs(now.volume - volume) <= VOLUME_CHANGE * Math.abs(volume);
  });
}

interface ShapeSummary {
  volume: number;
  isClosed: boolean;
}

function shapesOf(joined: JoinedShapes): ShapeSummary[] {
  const summaries = joined.names.map((): ShapeSummary => ({ volume: 0, isClosed: true }));
  const edges = joined.names.map(() => new Set<number>());
  const origin = cornersOf(joined, 0)[0];
  joined.shapeOf.forEach((shape, t) => {
    const [summary, open] = [summaries[shape], edges[shape]];
    if (summary === undefined || open === undefined || joined.isDropped[t] === 1) return;
    const [a, b, c] = cornersOf(joined, t).map((p) => minus(p, origin)) as [Vector, Vector, Vector];
    summary.volume += dot(a, cross(b, c)) / 6;
    for (let k = 0; k < 3; k++) {
      const [from, to] = [joined.triangles[3 * t + k] ?? 0, joined.triangles[3 * t + ((k + 1) % 3)] ?? 0];
      if (!open.delete(directedKey(to, from))) {
        if (open.has(directedKey(from, to))) summary.isClosed = false;
        open.add(directedKey(from, to));
      }
    }
  });
  summaries.forEach((summary, s) => (summary.isClosed &&= edges[s]?.size === 0));
  return summaries;
}

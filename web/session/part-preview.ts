import type { Project, ProjectPreview } from "tetrafront/project";
import { emptyProject } from "../document/create";
import type { Position } from "../document/position";
import { length, subtract } from "../document/vectors";

/** Lines and patches of a project that differ from a sampled one, as a project of their own. */
export interface ChangedPart {
  /** What must be sampled again; null if nothing must. */
  readonly project: Project | null;
  /** Indices in the whole project of the lines and patches of the part. */
  readonly lines: readonly number[];
  readonly patches: readonly number[];
  /** What has been moved without a change of shape; null if nothing has. */
  readonly shifted: ShiftedPart | null;
}

/** Lines and patches whose points were all moved by the same offset, by their indices in the whole project. */
export interface ShiftedPart {
  readonly offset: Position;
  readonly lines: ReadonlySet<number>;
  readonly patches: ReadonlySet<number>;
}

/** Offsets of points are the same if they differ by at most this, relative to the largest coordinate of what is moved. */
const sameOffset = 1e-12;

/** Largest part that is worth a preview of its own: patches, relative to the whole. */
const maxShare = 0.5;

/**
 * Returns what differs between a sampled project and a later one with the same lines and patches in the same order. What was
 * moved as a whole need not be sampled again. Null if nothing differs, or too much, or lines and patches were added, removed
 * or reordered. O(size).
 */
export function changedPart(sampled: Project, project: Project): ChangedPart | null {
  const isAlike = (a: readonly { readonly id: number }[], b: readonly { readonly id: number }[]): boolean =>
    a === b || (a.length === b.length && a.every(({ id }, i) => id === b[i]?.id));
  const { points, lines, patches } = project;
  if (!isAlike(points, sampled.points) || !isAlike(lines, sampled.lines)) return null;
  if (!isAlike(patches, sampled.patches)) return null;
  const moves = movesBetween(sampled.points, points);
  const moved = new Set(moves.map(({ id }) => id));
  const offset = commonOffset(moves);
  const bentIds = new Set<number>();
  const shiftedIds = new Set<number>();
  lines.forEach((line, i) => {
    const isSame = line === sampled.lines[i];
    if (isSame && !line.points.some((id) => moved.has(id))) return;
    const isShifted = isSame && offset !== null && line.points.every((id) => moved.has(id));
    (isShifted ? shiftedIds : bentIds).add(line.id);
  });
  const changed: number[] = [];
  const shiftedPatches = new Set<number>();
  patches.forEach((patch, i) => {
    const around = patch.loops.flat().map(Math.abs);
    const isSame = patch === sampled.patches[i];
    if (isSame && !around.some((id) => bentIds.has(id) || shiftedIds.has(id))) return;
    if (isSame && around.every((id) => shiftedIds.has(id))) shiftedPatches.add(i);
    else changed.push(i);
  });
  if (bentIds.size + shiftedIds.size + changed.length === 0) return null;
  if (changed.length > maxShare * patches.length) return null;
  const around = new Set(changed.flatMap((i) => patches[i]?.loops.flat().map(Math.abs) ?? []));
  const indicesOf = (ids: ReadonlySet<number>, others: ReadonlySet<number> = new Set()): number[] =>
    lines.flatMap(({ id }, i) => (ids.has(id) || others.has(id) ? [i] : []));
  const own = indicesOf(bentIds, around);
  const partLines = own.flatMap((i) => lines[i] ?? []);
  const ends = new Set(partLines.flatMap((line) => line.points));
  return {
    project:
      own.length + changed.length === 0
        ? null
        : {
            ...emptyProject(project.name),
            points: points.filter(({ id }) => ends.has(id)),
            lines: partLines,
            patches: changed.flatMap((i) => patches[i] ?? []),
          },
    lines: own,
    patches: changed,
    shifted: offset && { offset, lines: new Set(indicesOf(shiftedIds)), patches: shiftedPatches },
  };
}

interface Move {
  readonly id: number;
  readonly from: Position;
  readonly to: Position;
}

/** Returns how the points of a list differ from those of another one with the same ids. */
function movesBetween(before: Project["points"], after: Project["points"]): readonly Move[] {
  const moves: Move[] = [];
  for (const [i, point] of after.entries()) {
    const old = before[i];
    if (old && point !== old) moves.push({ id: point.id, from: old.position, to: point.position });
  }
  return moves;
}

/** Returns the offset of all moves; null if there are several, or no move. */
function commonOffset(moves: readonly Move[]): Position | null {
  // The offset of any of them may be rounded as coarsely as its coordinates.
  const coordinates = moves.flatMap(({ from, to }) => [...from, ...to]);
  const size = coordinates.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
  const [offset = null, ...others] = moves.map(({ from, to }) => subtract(to, from));
  const isSame = (own: Position): boolean =>
    offset !== null && length(subtract(own, offset)) <= sameOffset * size;
  return others.every(isSame) ? offset : null;
}

/**
 * Returns the samples of a whole project, with those of a part in place of the former ones, and with what was shifted. The
 * problems stay the former.
 */
export function withPart(
  before: ProjectPreview,
  part: ProjectPreview | null,
  { lines, patches, shifted }: Omit<ChangedPart, "project">,
): ProjectPreview {
  const whole = shifted ? withShift(before, shifted) : before;
  if (part === null) return whole;
  const lineAt = new Map(lines.map((index, i) => [index, i]));
  const patchAt = new Map(patches.map((index, i) => [index, i]));
  const sourceOf = (at: ReadonlyMap<number, number>, index: number) => {
    const own = at.get(index);
    return own === undefined ? ([whole, index] as const) : ([part, own] as const);
  };
  const lineCount = whole.lineOffsets.length - 1;
  const courses = Array.from({ length: lineCount }, (_, line) => {
    const [from, index] = sourceOf(lineAt, line);
    return from.linePoints.subarray(
      3 * (from.lineOffsets[index] ?? 0),
      3 * (from.lineOffsets[index + 1] ?? 0),
    );
  });
  const patchCount = whole.patchOffsets.length - 1;
  const surfaces = Array.from({ length: patchCount }, (_, patch) => surfaceOf(...sourceOf(patchAt, patch)));
  const firstNodes = offsetsOf(surfaces.map(({ points }) => points.length / 3));
  const triangles = surfaces.map(({ triangles: own, first }, patch) =>
    own.map((node) => node - first + (firstNodes[patch] ?? 0)),
  );
  return {
    ...whole,
    linePoints: joined(Float64Array, courses),
    lineOffsets: offsetsOf(courses.map(({ length }) => length / 3)),
    patchPoints: joined(
      Float64Array,
      surfaces.map(({ points }) => points),
    ),
    patchTriangles: joined(Uint32Array, triangles),
    patchOffsets: offsetsOf(triangles.map(({ length }) => length / 3)),
  };
}

/** Returns samples with some lines and patches shifted. */
function withShift(whole: ProjectPreview, { offset, lines, patches }: ShiftedPart): ProjectPreview {
  const linePoints = whole.linePoints.slice();
  for (const line of lines) {
    const [first = 0, end = 0] = whole.lineOffsets.subarray(line, line + 2);
    shift(linePoints.subarray(3 * first, 3 * end), offset);
  }
  const patchPoints = whole.patchPoints.slice();
  for (const patch of patches) {
    const { first, points } = surfaceOf(whole, patch);
    shift(patchPoints.subarray(3 * first, 3 * first + points.length), offset);
  }
  return { ...whole, linePoints, patchPoints };
}

function shift(positions: Float64Array, offset: Position): void {
  positions.forEach((x, i) => (positions[i] = x + (offset[i % 3] ?? 0)));
}

/** Returns the triangles of a patch and the nodes that they use, from the first one on. */
function surfaceOf({ patchOffsets, patchPoints, patchTriangles }: ProjectPreview, patch: number) {
  const triangles = patchTriangles.subarray(
    3 * (patchOffsets[patch] ?? 0),
    3 * (patchOffsets[patch + 1] ?? 0),
  );
  let [first, last] = [triangles[0] ?? 0, triangles[0] ?? -1];
  for (const node of triangles) {
    if (node < first) first = node;
    if (node > last) last = node;
  }
  return { triangles, first, points: patchPoints.subarray(3 * first, 3 * last + 3) };
}

/** Returns 0 and the sums of the first counts, one more than there are counts. */
function offsetsOf(counts: readonly number[]): Uint32Array {
  const offsets = new Uint32Array(counts.length + 1);
  counts.forEach((count, i) => (offsets[i + 1] = (offsets[i] ?? 0) + count));
  return offsets;
}

function joined<List extends Float64Array | Uint32Array>(
  Kind: new (length: number) => List,
  lists: readonly List[],
): List {
  const all = new Kind(lists.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const list of lists) {
    all.set(list, at);
    at += list.length;
  }
  return all;
}

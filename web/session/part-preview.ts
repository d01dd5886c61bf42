import type { Project, ProjectPreview } from "tetrafront";
import { emptyProject } from "../document/create";

/** Lines and patches of a project that differ from a sampled one, as a project of their own. */
export interface ChangedPart {
  readonly project: Project;
  /** Indices in the whole project of the lines and patches of the part. */
  readonly lines: readonly number[];
  readonly patches: readonly number[];
}

/** Largest part that is worth a preview of its own: patches, relative to the whole. */
const maxShare = 0.5;

/**
 * Returns what differs between a sampled project and a later one with the same lines and patches in the same order. Null if
 * nothing does, or too much, or lines and patches were added, removed or reordered. O(size).
 */
export function changedPart(sampled: Project, project: Project): ChangedPart | null {
  const isAlike = (a: readonly { readonly id: number }[], b: readonly { readonly id: number }[]): boolean =>
    a === b || (a.length === b.length && a.every(({ id }, i) => id === b[i]?.id));
  const { points, lines, patches } = project;
  if (!isAlike(points, sampled.points) || !isAlike(lines, sampled.lines)) return null;
  if (!isAlike(patches, sampled.patches)) return null;
  const moved = new Set(points.flatMap((point, i) => (point === sampled.points[i] ? [] : [point.id])));
  const bent = lines.flatMap((line, i) =>
    line === sampled.lines[i] && !line.points.some((id) => moved.has(id)) ? [] : [i],
  );
  const bentIds = new Set(bent.map((i) => lines[i]?.id));
  const changed = patches.flatMap((patch, i) =>
    patch === sampled.patches[i] && !patch.loops.flat().some((step) => bentIds.has(Math.abs(step)))
      ? []
      : [i],
  );
  if (bent.length + changed.length === 0 || changed.length > maxShare * patches.length) return null;
  const around = new Set(changed.flatMap((i) => patches[i]?.loops.flat().map(Math.abs) ?? []));
  const own = lines.flatMap((line, i) => (bentIds.has(line.id) || around.has(line.id) ? [i] : []));
  const partLines = own.flatMap((i) => lines[i] ?? []);
  const ends = new Set(partLines.flatMap((line) => line.points));
  return {
    project: {
      ...emptyProject(project.name),
      meshing: { size: 1 },
      points: points.filter(({ id }) => ends.has(id)),
      lines: partLines,
      patches: changed.flatMap((i) => patches[i] ?? []),
    },
    lines: own,
    patches: changed,
  };
}

/** Returns the samples of a whole project, with those of a part in place of the former ones. The problems stay the former. */
export function withPart(
  whole: ProjectPreview,
  part: ProjectPreview,
  { lines, patches }: Pick<ChangedPart, "lines" | "patches">,
): ProjectPreview {
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

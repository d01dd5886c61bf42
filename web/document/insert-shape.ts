import type { Project, ProjectLine, ProjectPatch, ProjectPoint } from "tetrafront/project";
import { nextId } from "./create";
import type { Entity } from "./entities";
import { closedDirection, isClosed, lineKey, loopsKey, sameCourse } from "./line-courses";
import { PointIndex } from "./point-index";
import type { Position } from "./position";
import type { Shape, ShapeLine } from "./shape";
import { distance } from "./vectors";

/** Points closer than this are one, relative to the extent of the model and the shape: as in the engine. */
const coincidence = 1e-9;

export interface InsertOptions {
  /** Share points, lines and patches of the project that coincide with those of the shape. */
  readonly join: boolean;
}

/** Records to add to a project, and the ids that each part of a shape has in it, also if it was there before. */
export interface Insertion {
  readonly points: readonly ProjectPoint[];
  readonly lines: readonly ProjectLine[];
  readonly patches: readonly ProjectPatch[];
  /** The id of each point of the shape; undefined for points that only lines shared with the project use. */
  readonly pointIds: readonly (number | undefined)[];
  /** The id of each line of the shape; negative if the project's line has the opposite direction. */
  readonly lineIds: readonly number[];
  /** The id of each patch of the shape. */
  readonly patchIds: readonly number[];
}

/** Returns the length below which positions of a project and of further points are one position. */
export function coincidenceLength(project: Project, further: readonly Position[] = []): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const include = (position: Position): void =>
    position.forEach((x, axis) => {
      low[axis] = Math.min(low[axis] ?? x, x);
      high[axis] = Math.max(high[axis] ?? x, x);
    });
  for (const { position } of project.points) include(position);
  further.forEach(include);
  const extent = Math.hypot(...high.map((x, axis) => x - (low[axis] ?? x)));
  return coincidence * (extent > 0 && Number.isFinite(extent) ? extent : 1);
}

/**
 * Returns what to add to a project so that it contains a shape. Points of the shape never join each other. O(size of
 * the project and the shape).
 */
export function insertion(project: Project, shape: Shape, { join }: InsertOptions): Insertion {
  const lines = new LineInsertion(project, shape, join);
  const lineIds = shape.lines.map((line) => lines.insert(line));
  const used = new Set(shape.lines.flatMap((line) => line.points));
  // A point without lines is wanted for itself.
  const pointIds = shape.points.map((_, index) =>
    used.has(index) ? lines.knownId(index) : lines.idOf(index),
  );
  const patches: ProjectPatch[] = [];
  const known = new Map(join ? project.patches.map((patch) => [loopsKey(patch.loops), patch.id]) : []);
  const names = new Set(project.patches.flatMap(({ name }) => (name === undefined ? [] : [name])));
  const firstId = nextId(project, "patch");
  const patchIds = shape.patches.map(({ type, loops, name }) => {
    const signed = loops.map((loop) =>
      loop.map((step) => Math.sign(step) * (lineIds[Math.abs(step) - 1] ?? 0)),
    );
    const shared = known.get(loopsKey(signed));
    if (shared !== undefined) return shared;
    const id = firstId + patches.length;
    patches.push({ id, ...(name !== undefined && { name: freeName(name, names) }), type, loops: signed });
    return id;
  });
  return { points: lines.newPoints, lines: lines.newLines, patches, pointIds, lineIds, patchIds };
}

/** Returns a name that no patch has yet, by a number if necessary, and reserves it. */
export function freeName(name: string, taken: Set<string>): string {
  let free = name;
  for (let count = 2; taken.has(free); ++count) free = `${name} (${count})`;
  taken.add(free);
  return free;
}

/** Gives ids to the points and lines of a shape. */
class LineInsertion {
  readonly newPoints: ProjectPoint[] = [];
  readonly newLines: ProjectLine[] = [];
  readonly #shape: Shape;
  readonly #tolerance: number;
  readonly #existing: PointIndex<number>;
  readonly #positions: ReadonlyMap<number, Position>;
  /** Lines of the project, by type and ends. */
  readonly #candidates = new Map<string, ProjectLine[]>();
  /** Lines of the project that end where they begin. */
  readonly #closed: readonly ProjectLine[] = [];
  readonly #ids = new Map<number, number>();
  #nextPoint: number;
  #nextLine: number;

  constructor(project: Project, shape: Shape, join: boolean) {
    this.#shape = shape;
    this.#tolerance = coincidenceLength(project, shape.points);
    this.#existing = new PointIndex<number>(this.#tolerance);
    this.#positions = new Map(project.points.map(({ id, position }) => [id, position]));
    this.#nextPoint = nextId(project, "point");
    this.#nextLine = nextId(project, "line");
    if (!join) return;
    for (const { id, position } of project.points) this.#existing.add(position, id);
    this.#closed = project.lines.filter(isClosed);
    for (const line of project.lines) {
      const key = lineKey(line);
      const same = this.#candidates.get(key);
      if (same) same.push(line);
      else this.#candidates.set(key, [line]);
    }
  }

  /** The id of a point that has one: its own, or that of a point of the project at its position. */
  knownId(index: number): number | undefined {
    const given = this.#ids.get(index);
    if (given !== undefined) return given;
    const position = this.#shape.points[index];
    return position && this.#existing.find(position);
  }

  /** The id of a point, which is added unless it has one. */
  idOf(index: number): number {
    const known = this.knownId(index);
    const id = known ?? this.#nextPoint++;
    const position = this.#shape.points[index];
    if (known === undefined && position) this.newPoints.push({ id, position });
    this.#ids.set(index, id);
    return id;
  }

  /** The signed id of a line, which is added with its points unless the project has it. */
  insert({ type, points, startTangent, endTangent }: ShapeLine): number {
    const shared = this.#sharedLine({ type, points });
    if (shared !== undefined) return shared;
    const id = this.#nextLine++;
    this.newLines.push({
      id,
      type,
      points: points.map((point) => this.idOf(point)),
      ...(startTangent && { startTangent }),
      ...(endTangent && { endTangent }),
    });
    return id;
  }

  #sharedLine({ type, points }: ShapeLine): number | undefined {
    if (isClosed({ points })) return this.#sharedClosedLine({ type, points });
    const [from, to] = [points.at(0), points.at(-1)].map((end) => this.knownId(end ?? 0));
    if (from === undefined || to === undefined) return undefined;
    const course = this.#courseOf(points);
    for (const line of this.#candidates.get(lineKey({ type, points: [from, to] })) ?? []) {
      const other = line.points.map((point) => this.#positions.get(point) ?? ([0, 0, 0] as const));
      if (line.points[0] === from && sameCourse(type, course, other, this.#isSame)) return line.id;
      if (line.points[0] === to && sameCourse(type, course, other.toReversed(), this.#isSame))
        return -line.id;
    }
    return undefined;
  }

  /** A closed line of the project with the same course, wherever it begins. */
  #sharedClosedLine({ type, points }: ShapeLine): number | undefined {
    const course = this.#courseOf(points);
    for (const line of this.#closed) {
      if (line.type !== type) continue;
      const other = line.points.map((point) => this.#positions.get(point) ?? ([0, 0, 0] as const));
      const direction = closedDirection(type, course, other, this.#isSame);
      if (direction !== 0) return direction * line.id;
    }
    return undefined;
  }

  #courseOf(points: readonly number[]): readonly Position[] {
    return points.map((point) => this.#shape.points[point] ?? ([0, 0, 0] as const));
  }

  readonly #isSame = (a: Position, b: Position): boolean => distance(a, b) <= this.#tolerance;
}

/** Returns lists with the records of an insertion; unchanged lists stay the same. */
export function withInsertion(lists: Pick<Project, "points" | "lines" | "patches">, made: Insertion) {
  const joined = <Item>(list: readonly Item[], more: readonly Item[]): readonly Item[] =>
    more.length === 0 ? list : [...list, ...more];
  return {
    points: joined(lists.points, made.points),
    lines: joined(lists.lines, made.lines),
    patches: joined(lists.patches, made.patches),
  };
}

/** Adds the records of an insertion to the lists of a project. */
export function insertInto(
  lists: { points: ProjectPoint[]; lines: ProjectLine[]; patches: ProjectPatch[] },
  { points, lines, patches }: Insertion,
): void {
  lists.points.push(...points);
  lists.lines.push(...lines);
  lists.patches.push(...patches);
}

/** The entities of a shape in a project: its patches; without any its lines, else its points. */
export function mainEntities({ pointIds, lineIds, patchIds }: Insertion): Entity[] {
  if (patchIds.length > 0) return patchIds.map((id) => ({ kind: "patch", id }));
  if (lineIds.length > 0) return lineIds.map((id) => ({ kind: "line", id: Math.abs(id) }));
  return pointIds.flatMap((id) => (id === undefined ? [] : [{ kind: "point", id }]));
}

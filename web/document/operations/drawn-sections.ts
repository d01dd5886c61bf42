import type { Loop, Profile } from "tetrafront/internal";
import type { Project, ProjectLine } from "tetrafront/project";
import { defaultName, operationStrings } from "../../strings";
import { entityName, findRecord, type Entity } from "../entities";
import { orderLoops } from "../loops";
import type { Position } from "../position";
import { distance, mean } from "../vectors";
import type { Typed } from "./feature-numbers";
import { drawnCurves, profileWithin } from "./solid-profiles";

const { refusals } = operationStrings;

/** A drawn loop that a loft passes through. */
interface Section {
  readonly profile: Typed<Profile>;
  /** How it is called: its patch, or its first line. */
  readonly name: string;
  readonly centre: Position;
}

type Found<What> = ({ readonly success: true } & What) | { readonly success: false; readonly reason: string };

/** A piece of the selection that bounds one section: a patch, or lines that are connected. */
interface Part {
  readonly name: string;
  readonly loops: readonly (readonly number[])[] | null;
}

/** The order in which a loft passes through its sections: as they were selected, or from the first to the nearest each time. */
export type SectionOrder = "selected" | "nearest";

/** Returns the profiles within selected patches and connected lines, or why they are no sections of a loft. */
export function drawnSections(
  project: Project,
  selection: readonly Entity[],
  order: SectionOrder,
): Found<{ readonly sections: readonly Section[] }> {
  const parts = partsOf(project, selection);
  if (parts.length < 2) return { success: false, reason: refusals.twoSections };
  const sections: Section[] = [];
  for (const { name, loops } of parts) {
    if (!loops) return { success: false, reason: refusals.openSection(name) };
    const found = profileWithin(project, loops);
    if (!found.success) return found;
    sections.push({ profile: found.profile, name, centre: mean(positionsOf(project, loops.flat())) });
  }
  return { success: true, sections: order === "nearest" ? fromNearestToNearest(sections) : sections };
}

function fromNearestToNearest(sections: readonly Section[]): readonly Section[] {
  const [first, ...left] = sections;
  const ordered = first ? [first] : [];
  while (left.length > 0) {
    const last = ordered.at(-1);
    const distances = left.map(({ centre }) => (last ? distance(last.centre, centre) : 0));
    ordered.push(...left.splice(distances.indexOf(Math.min(...distances)), 1));
  }
  return ordered;
}

/** Returns the profile within a selected patch or loop, and the other selected lines as a path from it. */
export function drawnSweep(
  project: Project,
  selection: readonly Entity[],
): Found<{ readonly profile: Typed<Profile>; readonly path: Typed<Loop> }> {
  const patches = selection.flatMap(({ kind, id }) => (kind === "patch" ? [id] : []));
  const chosen = linesOf(project, selection);
  const [patch, ...others] = patches;
  if (others.length > 0) return { success: false, reason: refusals.loopAndPath };
  const outline = patch === undefined ? undefined : findRecord(project, "patch", patch)?.loops;
  const around = new Set(
    outline?.flat().map(Math.abs) ?? chosen.filter(isInLoop(chosen)).map(({ id }) => id),
  );
  const loops = outline ?? loopsOf(project, [...around]);
  const path = chosen.filter(({ id }) => !around.has(id));
  if (!loops || path.length === 0) return { success: false, reason: refusals.loopAndPath };
  const found = profileWithin(project, loops);
  if (!found.success) return found;
  const centre = mean(positionsOf(project, loops.flat()));
  const chain = chainFrom(project, path, centre);
  if (!chain) return { success: false, reason: refusals.oneOpenPath };
  const curves = drawnCurves(project, [chain])?.[0];
  if (!curves) return { success: false, reason: refusals.curvesOfFeatures };
  return { success: true, profile: found.profile, path: curves };
}

const linesOf = (project: Project, selection: readonly Entity[]): readonly ProjectLine[] =>
  selection
    .flatMap(({ kind, id }) => (kind === "line" ? [findRecord(project, "line", id) ?? []] : []))
    .flat();

const endsOf = ({ points }: ProjectLine): readonly [number, number] => [points[0] ?? 0, points.at(-1) ?? 0];

/** Returns what the selection says section by section, in its order. */
function partsOf(project: Project, selection: readonly Entity[]): readonly Part[] {
  const groupOf = connected(linesOf(project, selection));
  const done = new Set<readonly number[]>();
  return selection.flatMap((entity): Part[] => {
    const name = entityName(project, entity) ?? defaultName(entity.kind, entity.id);
    if (entity.kind === "patch")
      return [{ name, loops: findRecord(project, "patch", entity.id)?.loops ?? null }];
    const group = entity.kind === "line" ? groupOf.get(entity.id) : undefined;
    if (!group || done.has(group)) return [];
    done.add(group);
    return [{ name, loops: loopsOf(project, group) }];
  });
}

/** Returns the one loop that lines form; null if they form none, or several. */
function loopsOf(project: Project, lines: readonly number[]): readonly (readonly number[])[] | null {
  const found = orderLoops(project, lines);
  return found.success && found.loops.length === 1 ? found.loops : null;
}

/** Returns the lines that are connected to each line, itself included: the same list for all of them. */
function connected(lines: readonly ProjectLine[]): ReadonlyMap<number, readonly number[]> {
  const groups = new Map<number, readonly number[]>();
  const at = linesAt(lines);
  for (const { id } of lines) {
    if (groups.has(id)) continue;
    const group = new Set([id]);
    for (const member of group) for (const other of at.neighbours(member)) group.add(other);
    const list = [...group];
    for (const member of list) groups.set(member, list);
  }
  return groups;
}

function linesAt(lines: readonly ProjectLine[]) {
  const at = new Map<number, ProjectLine[]>();
  for (const line of lines)
    for (const end of new Set(endsOf(line))) at.set(end, [...(at.get(end) ?? []), line]);
  const byId = new Map(lines.map((line) => [line.id, line]));
  const neighbours = (id: number): number[] => {
    const line = byId.get(id);
    return line ? endsOf(line).flatMap((end) => (at.get(end) ?? []).map((other) => other.id)) : [];
  };
  return { at, neighbours };
}

/** Returns whether a line is left if lines with a loose end are taken away one after the other. */
function isInLoop(lines: readonly ProjectLine[]): (line: ProjectLine) => boolean {
  const left = new Set(lines);
  const isLoose = (line: ProjectLine): boolean => {
    const [start, end] = endsOf(line);
    const meets = (point: number): boolean =>
      [...left].some((other) => other !== line && endsOf(other).includes(point));
    return start !== end && !(meets(start) && meets(end));
  };
  for (let before = Infinity; left.size < before;) {
    before = left.size;
    for (const line of left) if (isLoose(line)) left.delete(line);
  }
  return (line) => left.has(line);
}

/** Returns lines as one open chain that begins at its end nearest to a position; null if they form none. */
function chainFrom(
  project: Project,
  lines: readonly ProjectLine[],
  near: Position,
): readonly number[] | null {
  const { at } = linesAt(lines);
  const ends = [...at].filter(([, own]) => own.length === 1).map(([point]) => point);
  const isBranched = [...at.values()].some((own) => own.length > 2);
  if (ends.length !== 2 || isBranched) return null;
  const gap = (point: number): number =>
    distance(findRecord(project, "point", point)?.position ?? near, near);
  const [one = 0, other = 0] = ends;
  const chain: number[] = [];
  let from = gap(one) <= gap(other) ? one : other;
  const left = new Set(lines);
  for (;;) {
    const next = at.get(from)?.find((line) => left.has(line));
    if (!next) break;
    left.delete(next);
    const [start, end] = endsOf(next);
    chain.push(start === from ? next.id : -next.id);
    from = start === from ? end : start;
  }
  return left.size === 0 ? chain : null;
}

function positionsOf(project: Project, steps: readonly number[]): Position[] {
  const points = new Set(steps.flatMap((step) => findRecord(project, "line", Math.abs(step))?.points ?? []));
  return [...points].flatMap((id) => {
    const point = findRecord(project, "point", id);
    return point ? [point.position] : [];
  });
}

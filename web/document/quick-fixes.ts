import type { Project, ProjectLine } from "tetrafront/project";
import { fixStrings } from "../strings";
import { offerPatch } from "./create";
import type { DrawnLoop } from "./drawn-loop";
import type { ProjectEdit } from "./edit";
import { findRecord, type DrawnKind } from "./entities";
import { likelySize, uniformSize } from "./extent";
import { linePaths } from "./line-paths";
import { drawnLoops, keyOf } from "./loop-search";
import { orderLoops } from "./loops";
import { loopsToFill } from "./loops-to-fill";
import { cutsAtCrossings, sampledPath } from "./splits/line-crossings";
import { changedLists, splitLines, type Cut } from "./splits/split-line";
import { joinLinePair, joinPair } from "./transforms/join-points";
import type { Problem } from "./validate";

/** Changes that solve problems without a decision of the user. Each says what it does; one fix is one step of undo. */
export interface QuickFix {
  /** Label of the button. */
  readonly label: string;
  /** One sentence: what it will do. */
  readonly effect: string;
  /** What it does to the background grid with the help of the engine; null if it is an edit. */
  readonly cover: GridCover | null;
  /** Returns the fixed project; the same one if the problem is gone. */
  readonly apply: (project: Project) => Project;
}

/** A grid of one size around the model, or the given grid, which then covers the model by its margin. */
export type GridCover = { readonly kind: "replace"; readonly size: number } | { readonly kind: "extend" };

/** What the search for a fix knows beside the problem. */
export interface FixContext {
  readonly project: Project;
  /** All problems: open edges that belong together are closed by one patch. */
  readonly problems: readonly Problem[];
}

/** Returns the fix of a problem; null if there is no safe one. */
export function quickFixOf(problem: Problem, context: FixContext): QuickFix | null {
  if (problem.code === "outside-background-grid") return enlargeGrid(context);
  // Bodies have repairs of their own.
  if (problem.body !== null || problem.entities.some(({ kind }) => kind === "body")) return null;
  switch (problem.code) {
    case "duplicate-points":
      return joinPoints(problem);
    case "duplicate-lines":
      return joinLines(problem);
    case "loop-not-closed":
      return orderLoop(problem, context);
    case "open-circle":
      return closeCircle(problem);
    case "zero-length-line":
      return deleteLine(problem, context);
    case "degenerate-background-tetrahedron":
      return removeTetrahedron(problem);
    case "empty-background-grid":
      return covering(fixStrings.cover, { kind: "replace", size: likelySize(context.project) });
    case "open-edge":
      return splitOpenLine(problem, context) ?? closePatch(problem, context);
    default:
      return null;
  }
}

/** Returns the edit that makes a fix; null if it changes nothing. */
export function fixEdit(project: Project, label: string, fixes: readonly QuickFix[]): ProjectEdit | null {
  const fixed = fixes.reduce((current, { apply }) => apply(current), project);
  const { background } = fixed;
  const replace = {
    ...changedLists(project, fixed),
    ...(background !== project.background && { background }),
  };
  return Object.keys(replace).length > 0 ? { label, replace } : null;
}

const idsOf = ({ entities }: Problem, of: DrawnKind): readonly number[] =>
  entities.flatMap(({ kind, id }) => (kind === of ? [id] : []));

const simple = (text: Pick<QuickFix, "label" | "effect">, apply: QuickFix["apply"]): QuickFix => ({
  ...text,
  cover: null,
  apply,
});

const covering = (text: Pick<QuickFix, "label" | "effect">, cover: GridCover): QuickFix => ({
  ...text,
  cover,
  apply: (project) => project,
});

/** A larger grid if all nodes ask for the same size; otherwise the same grid with a margin, so that no size changes. */
function enlargeGrid({ project }: FixContext): QuickFix | null {
  const size = uniformSize(project);
  if (size !== undefined) return covering(fixStrings.enlarge, { kind: "replace", size });
  return project.background.tetrahedra.length > 0 ? covering(fixStrings.extend, { kind: "extend" }) : null;
}

function joinPoints(problem: Problem): QuickFix | null {
  const [a, b] = idsOf(problem, "point");
  if (a === undefined || b === undefined) return null;
  const [keep, drop] = [Math.min(a, b), Math.max(a, b)];
  return simple(fixStrings.joinPoints(keep, drop), (project) => ({
    ...project,
    ...joinPair(project, keep, drop),
  }));
}

function joinLines(problem: Problem): QuickFix | null {
  const [a, b] = idsOf(problem, "line");
  if (a === undefined || b === undefined) return null;
  const [keep, drop] = [Math.min(a, b), Math.max(a, b)];
  return simple(fixStrings.joinLines(keep, drop), (project) => ({
    ...project,
    ...joinLinePair(project, keep, drop),
  }));
}

/** Lines that form loops in another order or direction. */
function orderLoop(problem: Problem, { project }: FixContext): QuickFix | null {
  const [id] = idsOf(problem, "patch");
  const patch = id === undefined ? undefined : findRecord(project, "patch", id);
  if (!patch) return null;
  const ordered = (given: Project) => orderLoops(given, [...new Set(patch.loops.flat().map(Math.abs))]);
  if (!ordered(project).success) return null;
  return simple(fixStrings.orderLoop(patch.id), (current) => {
    const found = ordered(current);
    if (!found.success) return current;
    const patches = current.patches.map((one) =>
      one.id === patch.id ? { ...one, loops: found.loops.map((loop) => [...loop]) } : one,
    );
    return { ...current, patches };
  });
}

function closeCircle(problem: Problem): QuickFix | null {
  const [id] = idsOf(problem, "line");
  if (id === undefined) return null;
  const closed = (line: ProjectLine): ProjectLine => {
    const [first, second, third] = line.points;
    if (line.id !== id || first === undefined || second === undefined || third === undefined) return line;
    return { ...line, points: [first, second, third, first] };
  };
  return simple(fixStrings.closeCircle(id), (project) => ({ ...project, lines: project.lines.map(closed) }));
}

/** A line without length that no patch needs. */
function deleteLine(problem: Problem, { project }: FixContext): QuickFix | null {
  const [id] = idsOf(problem, "line");
  const isUsed = project.patches.some(({ loops }) => loops.flat().some((step) => Math.abs(step) === id));
  if (id === undefined || isUsed) return null;
  return simple(fixStrings.deleteLine(id), (current) => ({
    ...current,
    lines: current.lines.filter((line) => line.id !== id),
  }));
}

function removeTetrahedron(problem: Problem): QuickFix | null {
  const nodes = new Set(idsOf(problem, "background-node"));
  if (nodes.size === 0) return null;
  return simple(fixStrings.removeTetrahedron, (project) => ({
    ...project,
    background: {
      ...project.background,
      tetrahedra: project.background.tetrahedra.filter(
        (corners) => !(corners.every((id) => nodes.has(id)) && new Set(corners).size === nodes.size),
      ),
    },
  }));
}

/** The loop to fill at each open line, by list of problems: each problem of a list asks for one. */
const foundLoops = new WeakMap<readonly Problem[], ReadonlyMap<number, DrawnLoop>>();

function openLoops(project: Project, problems: readonly Problem[]): ReadonlyMap<number, DrawnLoop> {
  const known = foundLoops.get(problems);
  if (known) return known;
  const open = new Set(
    problems.filter(({ code }) => code === "open-edge").flatMap((one) => idsOf(one, "line")),
  );
  const paths = linePaths(project, null).filter((path) => open.has(path.line.id));
  const loops = loopsToFill(drawnLoops(paths).filter(({ normal }) => normal !== null));
  foundLoops.set(problems, loops);
  return loops;
}

/** The places at which each open line would have to be split, by list of problems. */
const foundCuts = new WeakMap<readonly Problem[], readonly Cut[]>();

function openCuts(project: Project, problems: readonly Problem[]): readonly Cut[] {
  const known = foundCuts.get(problems);
  if (known) return known;
  const open = new Set(
    problems.filter(({ code }) => code === "open-edge").flatMap((one) => idsOf(one, "line")),
  );
  const lines = project.lines.filter(({ id }) => open.has(id));
  const cuts = cutsAtCrossings(
    project,
    lines.map((line) => sampledPath(project, line)),
  );
  foundCuts.set(problems, cuts);
  return cuts;
}

/** An open line on which another open line ends. */
function splitOpenLine(problem: Problem, { project, problems }: FixContext): QuickFix | null {
  const [line] = idsOf(problem, "line");
  const cuts = openCuts(project, problems).filter((cut) => cut.line === line && cut.point !== undefined);
  const points = cuts.flatMap(({ point }) => point ?? []);
  if (line === undefined || points.length === 0) return null;
  if (splitLines(project, cuts).wholes.size === 0) return null;
  return simple(fixStrings.splitLine(line, points), (current) => splitLines(current, cuts).project);
}

/** Open lines that lie in one plane and form a loop, without the holes within it. */
function closePatch(problem: Problem, { project, problems }: FixContext): QuickFix | null {
  const [line] = idsOf(problem, "line");
  if (line === undefined) return null;
  const loop = openLoops(project, problems).get(line);
  if (!loop) return null;
  const outer = loop.lines.map(Math.abs);
  const holes = loop.holes.flat().map(Math.abs);
  const lines = [...outer, ...holes];
  const key = keyOf(outer);
  // A curved patch or a tube may begin at the same lines.
  const isFilled = (current: Project): boolean =>
    current.patches.some(({ type, loops: [first = []] }) => type === "planar" && keyOf(first) === key);
  return simple(fixStrings.closePatch(outer, holes), (current) => {
    if (isFilled(current)) return current;
    const selection = lines.map((id) => ({ kind: "line" as const, id }));
    const found = orderLoops(current, lines);
    const offer = offerPatch(current, selection, "planar");
    const id = offer.possible ? offer.creation.entities[0]?.id : undefined;
    if (id === undefined || !found.success) return current;
    const loops = found.loops.map((one) => [...one]);
    return { ...current, patches: [...current.patches, { id, type: "planar" as const, loops }] };
  });
}

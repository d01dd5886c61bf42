import type { Project } from "tetrafront/project";
import { offerHole, offerPatch, type Offer } from "../create";
import { findRecord, type Entity } from "../entities";
import { coincidenceLength } from "../insert-shape";
import type { LinePath } from "../line-paths";
import { linePositions } from "../line-samples";
import { freeLoops, type LoopUse } from "../loop-hits";
import { drawnLoops } from "../loop-search";
import { distance } from "../vectors";
import { lineCurve } from "./line-curve";
import { cutsAtCrossings, sampledPath } from "./line-crossings";
import { changedLists, splitLines, type Cut, type Divided } from "./split-line";

/**
 * Loops of lines that patches can fill, also of parts of lines: where a line ends on another one or crosses it, both are
 * split once a loop that needs it is filled.
 */
export interface FillableLoops {
  /** The project in which the loops are. */
  readonly divided: Divided;
  readonly cuts: readonly Cut[];
  readonly uses: readonly LoopUse[];
}

/** Returns the loops that no patch fills yet. */
export function fillableLoops(project: Project, paths: readonly LinePath[]): FillableLoops {
  const cuts = cutsAtCrossings(project, paths);
  const divided = splitLines(project, cuts);
  const known = new Map(paths.map((path) => [path.line, path]));
  const all =
    cuts.length === 0
      ? paths
      : divided.project.lines.map((line) => known.get(line) ?? sampledPath(divided.project, line));
  return { divided, cuts, uses: freeLoops(divided.project, drawnLoops(all)) };
}

/** Offers to fill a loop: a patch or a hole, after the lines were split that bound it in part. */
export function offerFill(project: Project, { divided, cuts }: FillableLoops, use: LoopUse): Offer {
  const pieces = [use.loop.lines, ...use.loop.holes].flat().map(Math.abs);
  const needed = cutsFor(project, divided, cuts, pieces);
  const split = needed.length === 0 ? project : splitLines(project, needed).project;
  const lines = pieces.flatMap((id): Entity[] => {
    const same = needed.length === 0 ? id : sameLine(divided.project, id, split);
    return same === undefined ? [] : [{ kind: "line", id: same }];
  });
  const outer = lines.slice(0, use.loop.lines.length);
  const offer =
    use.kind === "hole"
      ? offerHole(split, [{ kind: "patch", id: use.patch }, ...outer])
      : offerPatch(split, lines, null);
  if (!offer.possible || split === project) return offer;
  const { edit, entities } = offer.creation;
  const { label } = edit;
  const change = "change" in edit ? edit.change : () => undefined;
  return {
    possible: true,
    creation: {
      entities,
      edit: {
        label,
        change: (draft) => {
          Object.assign(draft.project, changedLists(project, split));
          change(draft);
        },
      },
    },
  };
}

/** Returns the places among those of all cuts at which the pieces of a loop end. */
function cutsFor(
  project: Project,
  { project: divided, wholes }: Divided,
  cuts: readonly Cut[],
  pieces: readonly number[],
): readonly Cut[] {
  const tolerance = 10 * coincidenceLength(project);
  const ends = pieces.flatMap((id) => {
    const whole = wholes.get(id);
    const positions = linePositions(divided, findRecord(divided, "line", id) ?? { points: [] });
    return whole === undefined
      ? []
      : [positions.at(0), positions.at(-1)].map((position) => ({ whole, position }));
  });
  return cuts.filter(({ line, position }) =>
    ends.some((end) => end.whole === line && end.position && distance(end.position, position) <= tolerance),
  );
}

/** Returns the line with the ends and the middle of a line of another project. */
function sameLine(from: Project, id: number, project: Project): number | undefined {
  const middleOf = (given: Project, line: LinePath["line"]) => {
    const positions = linePositions(given, line);
    const curve = lineCurve(line.type, positions);
    return curve && { start: curve.at(0), middle: curve.at(0.5), end: curve.at(1) };
  };
  const line = findRecord(from, "line", id);
  const course = line && middleOf(from, line);
  if (!line || !course) return undefined;
  const tolerance = 10 * coincidenceLength(from);
  const fitting = project.lines.flatMap((other) => {
    const its = other.type === line.type ? middleOf(project, other) : null;
    if (!its) return [];
    const isSame =
      distance(its.start, course.start) <= tolerance && distance(its.end, course.end) <= tolerance;
    return isSame ? [{ id: other.id, away: distance(its.middle, course.middle) }] : [];
  });
  return fitting.toSorted((a, b) => a.away - b.away)[0]?.id;
}

import type { LineType, PatchType, Project, ProjectLine, ProjectPatch } from "tetrafront/project";
import { entityNouns, selectionHints, stepNames } from "../strings";
import { idsOf, nextId, type Offer } from "./create";
import { changeLineTypes, changePatchTypes } from "./edits";
import { findRecord, type Entity } from "./entities";
import { isClosed } from "./line-courses";

/** Smooth surfaces from what is drawn: patches that join without an edge, and lofts through lines. */

/** The smooth type of each type that can become smooth. */
const smoothTypes: { readonly [P in PatchType]?: PatchType } = {
  coons: "gregory",
  serendipity: "gregory",
  "barnhill-gregory-nielson": "nielson",
  "isoparametric-triangle": "nielson",
};

/** Lines that can continue each other. Arcs and circles stay what they are. */
const flexible: ReadonlySet<LineType> = new Set(["straight", "parabolic", "spline"]);

const linesOf = ({ loops }: ProjectPatch): number[] => loops.flat().map(Math.abs);

/**
 * Offers to make the selected patches smooth, with the lines around them: Hermite lines, whose tangents at common points
 * follow from each other. Lines that other patches need as parabolas stay.
 */
export function offerSmooth(project: Project, selection: readonly Entity[]): Offer {
  const selected = new Set(idsOf(selection, "patch"));
  const patches = project.patches.filter(({ id, type }) => selected.has(id) && smoothTypes[type]);
  if (patches.length === 0) return { possible: false, reason: selectionHints.smooth };
  const changed = new Set(patches.map(({ id }) => id));
  const bound = new Set(
    project.patches
      .filter(
        ({ id, type }) => !changed.has(id) && (type === "serendipity" || type === "isoparametric-triangle"),
      )
      .flatMap(linesOf),
  );
  const around = new Set(patches.flatMap(linesOf));
  const lines = project.lines.filter(
    (line) => around.has(line.id) && !bound.has(line.id) && flexible.has(line.type) && !isClosed(line),
  );
  return {
    possible: true,
    creation: {
      entities: selection,
      edit: {
        label: stepNames.smooth(patches.length),
        change: ({ project: draft }) => {
          changeLineTypes(
            draft,
            lines.map(({ id }) => id),
            "hermite",
          );
          for (const type of ["gregory", "nielson"] as const) {
            const ids = patches.flatMap((patch) => (smoothTypes[patch.type] === type ? [patch.id] : []));
            changePatchTypes(draft, ids, type);
          }
        },
      },
    },
  };
}

type Step = { readonly line: ProjectLine; readonly sign: 1 | -1; readonly from: number; readonly to: number };

/** A line in one of its directions. */
function stepAlong(line: ProjectLine, sign: 1 | -1): Step {
  const [first = 0, last = 0] = [line.points.at(0), line.points.at(-1)];
  return sign === 1 ? { line, sign, from: first, to: last } : { line, sign, from: last, to: first };
}

/** Offers a loft through the selected lines, in their order, with splines through their ends as its sides. */
export function offerLoft(project: Project, selection: readonly Entity[]): Offer {
  const lines = idsOf(selection, "line").flatMap((id) => findRecord(project, "line", id) ?? []);
  if (lines.length < 2 || lines.some(isClosed)) return { possible: false, reason: selectionHints.loft };
  const ends = lines.flatMap(({ points }) => [points.at(0), points.at(-1)]);
  if (new Set(ends).size < ends.length) return { possible: false, reason: selectionHints.shared };
  const placeOf = (id: number) => findRecord(project, "point", id)?.position ?? ([0, 0, 0] as const);
  const squared = (a: number, b: number): number => {
    const [p, q] = [placeOf(a), placeOf(b)];
    return p.reduce((sum, x, k) => sum + (x - (q[k] ?? 0)) ** 2, 0);
  };
  // Each line runs in the direction of the one before it.
  const steps: Step[] = [];
  for (const line of lines) {
    const before = steps.at(-1);
    const [there, back] = [stepAlong(line, 1), stepAlong(line, -1)];
    const away = (step: Step): number =>
      before ? squared(step.from, before.from) + squared(step.to, before.to) : 0;
    steps.push(away(back) < away(there) ? back : there);
  }
  const [bottom] = steps;
  const top = steps.at(-1);
  if (!bottom || !top) return { possible: false, reason: selectionHints.loft };
  const id = nextId(project, "line");
  const type = steps.length > 2 ? "spline" : "straight";
  const patch = nextId(project, "patch");
  const sections = steps.slice(1, -1).map(({ line, sign }) => [sign * line.id]);
  return {
    possible: true,
    creation: {
      entities: [{ kind: "patch", id: patch }],
      edit: {
        label: stepNames.add(`${entityNouns.patch} ${patch}`),
        change: ({ project: draft }) => {
          draft.lines.push({ id, type, points: steps.map(({ to }) => to) });
          draft.lines.push({ id: id + 1, type, points: steps.map(({ from }) => from) });
          const outer = [bottom.sign * bottom.line.id, id, -top.sign * top.line.id, -(id + 1)];
          draft.patches.push({ id: patch, type: "loft", loops: [outer, ...sections] });
        },
      },
    },
  };
}

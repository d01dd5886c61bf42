import type { Project } from "tetrafront/project";
import { entityNouns, stepNames } from "../strings";
import { nextId, type Creation } from "./create";
import type { Position } from "./position";

/** Lines of a pasted text that are not empty and no comment. */
export function linesOf(text: string): readonly string[] {
  return text
    .split(/\r?\n/)
    .map((line) => line.trim())
    .filter((line) => line !== "" && !/^(#|\/\/|%)/.test(line));
}

/** Returns whether the first line of a list is a heading, such as `x,y,z`, if it is no position: it has words. */
export const isHeading = (line: string): boolean =>
  line.split(/[\s,;]+/).some((word) => /^["']?[a-z]/i.test(word));

/**
 * Returns the positions of a pasted list: two or three numbers per line, with commas, semicolons, tabs or spaces between
 * them. A first line of words is a heading. Null if the text is no such list.
 */
export function readPositionList(text: string): readonly Position[] | null {
  const positions = rowsOf(text).map(positionOf);
  const found = positions.filter((position) => position !== null);
  return found.length > 0 && found.length === positions.length ? found : null;
}

/** Returns the first line of a text that is no position, if the first row is one: the text is meant as a list. Else null. */
export function refusedLineOf(text: string): string | null {
  const [first, ...others] = rowsOf(text);
  if (first === undefined || positionOf(first) === null) return null;
  return others.find((line) => positionOf(line) === null) ?? null;
}

function rowsOf(text: string): readonly string[] {
  const lines = linesOf(text);
  return isHeading(lines[0] ?? "") ? lines.slice(1) : lines;
}

function positionOf(line: string): Position | null {
  const words = line.split(/[\s,;]+/).filter(Boolean);
  const [x, y, z = 0] = words.map(Number);
  const isPosition = words.length >= 2 && words.length <= 3 && x !== undefined && y !== undefined;
  return isPosition && [x, y, z].every(Number.isFinite) ? [x, y, z] : null;
}

/** Adds points as one step of undo. */
export function addPoints(project: Project, positions: readonly Position[]): Creation {
  const first = nextId(project, "point");
  const ids = positions.map((_, i) => first + i);
  return {
    entities: ids.map((id) => ({ kind: "point", id })),
    edit: {
      label:
        positions.length === 1
          ? stepNames.add(`${entityNouns.point} ${first}`)
          : stepNames.addPoints(ids.length),
      change: ({ project: draft }) => {
        // Not as arguments of one call, whose number has a limit.
        positions.forEach(([x, y, z], i) => draft.points.push({ id: first + i, position: [x, y, z] }));
      },
    },
  };
}

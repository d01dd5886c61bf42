import type { Project } from "tetrafront";
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

/**
 * Returns the positions of a pasted list: two or three numbers per line, with commas, semicolons, tabs or spaces between
 * them. A first line of words is a heading. Null if the text is no such list.
 */
export function readPositionList(text: string): readonly Position[] | null {
  const all = linesOf(text).map((line) => line.split(/[\s,;]+/).filter(Boolean));
  const [heading = []] = all;
  const rows = heading.some((word) => /^["']?[a-z]/i.test(word)) ? all.slice(1) : all;
  const positions = rows.map((words): Position | null => {
    const [x, y, z = 0] = words.map(Number);
    const isPosition = words.length >= 2 && words.length <= 3 && x !== undefined && y !== undefined;
    return isPosition && [x, y, z].every(Number.isFinite) ? [x, y, z] : null;
  });
  const found = positions.filter((position) => position !== null);
  return found.length > 0 && found.length === positions.length ? found : null;
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
        draft.points.push(
          ...positions.map((position, i) => ({
            id: first + i,
            position: [...position] as [number, number, number],
          })),
        );
      },
    },
  };
}

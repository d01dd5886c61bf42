import { describe, expect, it } from "vitest";
import {
  commonNumbers,
  commonType,
  setCommonLineType,
  setCommonNumber,
} from "../../../web/document/common-edits";
import type { Entity } from "../../../web/document/entities";
import { addParameter, setParameter } from "../../../web/document/parameters";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

const cube = cubeProject();
const points: readonly Entity[] = cube.points.slice(0, 4).map(({ id }) => ({ kind: "point", id }));
const nodes: readonly Entity[] = cube.background.nodes.map(({ id }) => ({ kind: "background-node", id }));

function opened() {
  const documents = new DocumentStore(cube, () => 0);
  const heights = () => documents.project.points.map(({ position }) => position[2]);
  return { documents, heights };
}

describe("what a selection has in common", () => {
  it("is the numbers of all its kinds, without a value where they differ", () => {
    expect(commonNumbers(cube, nodes).map(({ field }) => field)).toEqual([
      "position.0",
      "position.1",
      "position.2",
      "size",
      "stretching",
    ]);
    expect(commonNumbers(cube, [...points, ...nodes]).map(({ field }) => field)).toEqual([
      "position.0",
      "position.1",
      "position.2",
    ]);
    expect(commonNumbers(cube, [...points, { kind: "line", id: 1 }])).toEqual([]);
    const values = new Map(commonNumbers(cube, points).map(({ field, value }) => [field, value]));
    const xs = new Set(cube.points.slice(0, 4).map(({ position }) => position[0]));
    expect(xs.size).toBeGreaterThan(1);
    expect(values.get("position.0")).toBeNull();
    expect(commonNumbers(cube, nodes).find(({ field }) => field === "stretching")?.value).toBe(1);
  });

  it("changes in all entities as one step, with its expression", () => {
    const { documents, heights } = opened();
    const before = heights();
    documents.edit(addParameter("h", "3"));
    documents.edit(setCommonNumber(points, "position.2", 3, "h"));
    expect(documents.project.expressions).toHaveLength(4);
    expect(commonNumbers(documents.project, points)[2]).toEqual({
      field: "position.2",
      value: 3,
      expression: "h",
    });
    documents.edit(setParameter("h", "5"));
    expect(heights()).toEqual([5, 5, 5, 5, ...before.slice(4)]);
    documents.undo();
    documents.undo();
    expect(heights()).toEqual(before);
  });

  it("gives stretched nodes a direction", () => {
    const { documents } = opened();
    documents.edit(setCommonNumber(nodes, "stretching", 2, null));
    for (const { stretching, direction } of documents.project.background.nodes) {
      expect([stretching, direction]).toEqual([2, [1, 0, 0]]);
    }
  });

  it("includes the type of lines", () => {
    const { documents } = opened();
    const lines: readonly Entity[] = [1, 2].map((id) => ({ kind: "line", id }));
    expect(commonType(cube, lines, "line")).toBe("straight");
    expect(commonType(cube, lines, "patch")).toBeUndefined();
    documents.edit(setCommonLineType(lines.slice(0, 1), "spline"));
    expect(commonType(documents.project, lines, "line")).toBeNull();
  });
});

describe("a jump in the history", () => {
  it("goes to the model after any step, and back, without losing steps", () => {
    const { documents, heights } = opened();
    const states = [heights()];
    for (let step = 1; step <= 5; ++step) {
      documents.edit(setCommonNumber(points, "position.2", 10 * step, `5+5*${2 * step - 1}`));
      documents.edit(setCommonNumber(points.slice(0, 1), "position.0", step, null));
      states.push(heights());
    }
    for (const step of [2, 5, 0, 4, 1, 5]) {
      documents.jumpTo(2 * step);
      expect(heights()).toEqual(states[step]);
      const { past, future } = documents.state.getState().history;
      expect(past.length + future.length).toBe(10);
    }
  });
});

import { expect, it } from "vitest";
import { invertedSelection, loopAround, shownAmong } from "../../../web/document/select-related";
import type { Entity } from "../../../web/document/entities";
import { createBody } from "tetrafront/project";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";
import { ViewStore } from "../../../web/document/selection";

const ids = (entities: readonly Entity[]): readonly number[] => entities.map(({ id }) => id);

it("a loop is selected around a line, then the other loops through this line in turn", () => {
  const project = cubeProject();
  const line = { kind: "line", id: 1 } as const;
  const first = loopAround(project, [line]);
  const second = loopAround(project, first);
  const third = loopAround(project, second);
  for (const loop of [first, second]) {
    expect(loop).toHaveLength(4);
    expect(loop[0]).toEqual(line);
  }
  expect(ids(second).toSorted()).not.toEqual(ids(first).toSorted());
  expect(ids(third)).toEqual(ids(first));
  // Two lines decide which loop is meant.
  const other = second[1];
  if (!other) throw new Error("the loop has one line");
  expect(ids(loopAround(project, [line, other])).toSorted()).toEqual(ids(second).toSorted());
  expect(loopAround(project, [{ kind: "point", id: 1 }])).toEqual([{ kind: "point", id: 1 }]);
});

it("what the view does not show is not among what is shown: hidden entities, patches of hidden bodies, layers", () => {
  const bodies = [7, 8].map((id) => createBody(boxSurface(1), { id, firstPatchId: 10 * id }));
  const project = { ...cubeProject(), bodies };
  const view = new ViewStore();
  const shown = (selected: Entity) =>
    shownAmong(project, invertedSelection(project, [selected]), view.state.getState());
  expect(ids(shown({ kind: "body-patch", id: 999 }))).toEqual([70, 80]);
  view.setHidden([{ kind: "body", id: 7 }], true);
  expect(ids(shown({ kind: "body-patch", id: 999 }))).toEqual([80]);
  expect(ids(shown({ kind: "body", id: 999 }))).toEqual([8]);
  view.setLayer("points", false);
  expect(shown({ kind: "point", id: 1 })).toEqual([]);
});

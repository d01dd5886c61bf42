import { expect, it } from "vitest";
import { loopAround } from "../../../web/document/select-related";
import type { Entity } from "../../../web/document/entities";
import { cubeProject } from "../../support/projects";

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

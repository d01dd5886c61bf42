import { expect, it } from "vitest";
import type { Project } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { recordFinder } from "../../../web/document/number-paths";
import { randomSource } from "../../support/random";

it("records are found by id in every list, whatever lists were searched before", () => {
  const random = randomSource(11);
  const below = (limit: number): number => random() % limit;
  let project: Project = emptyProject("a");
  for (let i = 0; i < 2000; ++i) {
    const points = project.points.filter(() => below(8) > 0);
    points.splice(below(points.length + 1), 0, { id: 1000 + i, position: [i, 0, 0] });
    if (below(20) === 0) points.reverse();
    const before = recordFinder(project);
    const after = recordFinder({ ...project, points });
    for (let search = 0; search < 6; ++search) {
      const id = 1000 + i - below(20);
      expect(after({ kind: "point", id })).toBe(points.find((point) => point.id === id));
      expect(before({ kind: "point", id })).toBe(project.points.find((point) => point.id === id));
    }
    project = { ...project, points };
  }
});

/** The labels of lines and patches belong to those that the recorded front shows in space. */
import type { Project } from "tetrafront/project";
import { expect, test } from "vitest";
import { entityLabels, labelAt } from "../../../web/teach/player/entity-labels";
import { inSpace } from "../../../web/teach/player/surface-scene";
import { cubeProject } from "../../support/projects";
import { recordFront } from "../../support/recorded-models";

/** A cube whose ids are not its indices; every other line has a name. */
function cube(): Project {
  const project = cubeProject(0.5);
  return {
    ...project,
    lines: project.lines
      .toReversed()
      .map((line) => (line.id % 2 === 0 ? { ...line, name: `L${line.id}` } : line)),
    patches: [...project.patches.slice(2), ...project.patches.slice(0, 2)],
  };
}

/** Axis and coordinate of each patch of the cube. */
const planes: Readonly<Record<string, readonly [number, number]>> = {
  "“bottom”": [2, 0],
  "“top”": [2, 1],
  "“front”": [1, 0],
  "“back”": [1, 1],
  "“left”": [0, 0],
  "“right”": [0, 1],
};

test("labels are those of the lines and patches that are shown", async () => {
  const project = cube();
  const labels = entityLabels(project);
  const { surface } = await recordFront(project);
  if (!surface) throw new Error("the trace has no lines and patches");

  expect(surface.fronts).toHaveLength(6);
  for (const front of surface.fronts) {
    const [axis = 0, coordinate = NaN] = planes[labelAt(labels.patches, front.patch)] ?? [];
    for (let node = 0; node < front.boundaryNodes; node++)
      expect(inSpace(front, node)[axis]).toBeCloseTo(coordinate, 12);
  }
  const seen = new Set<string>();
  for (const { line, nodes } of surface.divisions) {
    const label = labelAt(labels.lines, line);
    seen.add(label);
    const id = Number(label.replace(/\D/g, ""));
    expect(label).toBe(id % 2 === 0 ? `“L${id}”` : String(id));
    const [first] = project.lines.find((other) => other.id === id)?.points ?? [];
    expect([...nodes.subarray(0, 3)]).toEqual(project.points.find((point) => point.id === first)?.position);
  }
  expect(seen.size).toBe(12);
});

test("without a name there is a number, and an empty name is none", () => {
  const project = cubeProject();
  const patches = project.patches.map((patch) => ({ ...patch, name: patch.id === 3 ? " " : undefined }));
  expect(entityLabels({ ...project, patches }).patches).toEqual(["1", "2", "3", "4", "5", "6"]);
  expect(labelAt(undefined, 1999)).toBe("2,000");
});

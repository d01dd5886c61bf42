import { createMesher, type Mesher, type Project } from "tetrafront";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { box } from "../../../web/document/pieces/box";
import { prism } from "../../../web/document/pieces/prism";
import { placedIn, type Shape } from "../../../web/document/shape";
import { frameAlong } from "../../../web/document/vectors";
import { regionVolumes } from "../../support/check-mesh";
import { expectValid } from "../../support/expect-valid";
import { moved, projectOf } from "../../support/pieces";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

/** Meshes a project, checks the mesh, and returns the volume of each region. */
async function volumesOf(project: Project): Promise<number[]> {
  const result = await mesher.meshProject(project);
  expect(result.report.diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
  expectValid(result);
  return regionVolumes(result.surface);
}

const volumeOf = async (shape: Shape, size: number): Promise<number> => {
  const volumes = await volumesOf(projectOf([shape], size));
  expect(volumes).toHaveLength(1);
  return volumes[0] ?? 0;
};

describe("pieces", () => {
  it("a box has its volume, along any axis", async () => {
    expect(await volumeOf(box(1, 2, 3), 0.7)).toBeCloseTo(6, 12);
    expect(await volumeOf(placedIn(box(1, 2, 3), frameAlong([1, 2, 3], [9, 8, 7])), 0.7)).toBeCloseTo(6, 9);
  });

  it.each([3, 5, 6, 12])("a prism of %i sides has its volume", async (sides) => {
    const area = (sides / 2) * 4 * Math.sin((2 * Math.PI) / sides);
    expect(await volumeOf(prism(sides, 2, 1.5), 0.8)).toBeCloseTo(area * 1.5, 9);
  });

  it("pieces that touch share points, lines and the patch between them", async () => {
    const cube = box(1, 1, 1);
    const project = projectOf([cube, moved(cube, [0, 0, 1]), moved(cube, [1, 0, 0])], 0.4);
    expect([project.points.length, project.lines.length, project.patches.length]).toEqual([16, 28, 16]);
    const volumes = await volumesOf(project);
    expect(volumes).toHaveLength(3);
    for (const volume of volumes) expect(volume).toBeCloseTo(1, 12);
  });
});

import { createMesher, type Mesher } from "tetrafront";
import { afterAll, beforeAll, expect, it } from "vitest";
import { templates } from "../../../web/document/templates";
import { enclosedVolume, meshVolume } from "../../support/check-mesh";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** Volumes by formula: the box, less what is inside it. */
const volumes: Readonly<Record<string, number>> = {
  box: 1,
  "sphere-in-box": 64 - (4 / 3) * Math.PI * 0.5 ** 3,
  "cylinder-in-box": 36 - Math.PI * 0.5 ** 2,
};

it.each(templates.map(({ id, make }) => [id, make] as const))(
  "%s has no errors and meshes",
  async (id, make) => {
    const project = make();
    expect(project.name.length).toBeGreaterThan(0);
    if (id === "empty") {
      expect(project.points).toEqual([]);
      return;
    }
    const { mesh, report } = await mesher.meshProject(project, { optimization: "fast" });
    expect(report.diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
    expect(report.status).toBe("done");
    expect(meshVolume(mesh)).toBeCloseTo(enclosedVolume(mesh), 6);
    const exact = volumes[id];
    if (exact !== undefined) expect(meshVolume(mesh) / exact).toBeCloseTo(1, 2);
    expect(report.tetrahedra).toBeLessThan(60_000);
  },
  120_000,
);

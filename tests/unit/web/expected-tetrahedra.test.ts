import { afterAll, describe, expect, it } from "vitest";
import { createMesher } from "tetrafront";
import type { ProjectSource } from "tetrafront/project";
import { expectedTetrahedra } from "../../../web/session/expected-tetrahedra";
import { cubeProject } from "../../support/projects";

const mesher = await createMesher();
afterAll(() => mesher.dispose());
const { signal } = new AbortController();

describe("expectedTetrahedra", () => {
  const near: ProjectSource = { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.03, distance: 0.1 };

  it.each([
    ["a uniform size", []],
    ["a source", [near]],
  ])("is within 25 % of the number in the mesh, with %s", async (_, sources) => {
    const cube = cubeProject();
    const size = 0.12;
    const expected = await expectedTetrahedra(mesher, cube, { size, sources }, signal);
    const project = { ...cube, background: { ...cube.background, sources } };
    const { report } = await mesher.meshProject(project, { size });
    expect(report.status).toBe("done");
    expect((expected ?? 0) / report.tetrahedra).toBeGreaterThan(0.8);
    expect((expected ?? 0) / report.tetrahedra).toBeLessThan(1.25);
  });

  it("is also known if the engine rejects so many tetrahedra", async () => {
    const expected = await expectedTetrahedra(mesher, cubeProject(), { size: 0.001, sources: [] }, signal);
    expect(expected).toBeGreaterThan(1e8);
  });

  it("is null if nothing can be meshed", async () => {
    const open = { ...cubeProject(), patches: [] };
    expect(await expectedTetrahedra(mesher, open, { size: 0.1, sources: [] }, signal)).toBeNull();
  });

  it("rejects when it is aborted", async () => {
    const abort = new AbortController();
    const pending = expectedTetrahedra(mesher, cubeProject(), { size: 0.02, sources: [] }, abort.signal);
    abort.abort();
    await expect(pending).rejects.toThrow();
  });
});

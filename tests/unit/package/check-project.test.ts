/** `checkProject` finds what `meshProject` finds before its front starts. */
import { createMesher, type Mesher } from "tetrafront";
import { createBody, type Project } from "tetrafront/project";
import { afterAll, beforeAll, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { boxSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const at = (low: number, size: number, id: number) =>
  createBody(boxSurface(2, [low, low, low], [low + size, low + size, low + size]), {
    id,
    firstPatchId: 20 + id,
    name: `body ${id}`,
  });

const cube = (): Project => ({ ...cubeProject(), meshing: { size: 0.25 } });

const projects: Readonly<Record<string, () => Project>> = {
  "a drawn cube": cube,
  "a cube without a patch": () => ({ ...cube(), patches: cube().patches.slice(1) }),
  "a body beside the cube": () => ({ ...cube(), bodies: [at(3, 1, 1)] }),
  "a body that intersects the cube": () => ({ ...cube(), bodies: [at(0.5, 1, 1)] }),
  "two bodies that intersect": () => ({ ...cube(), bodies: [at(3, 1, 1), at(3.5, 1, 2)] }),
  "sizes far too small": () => ({ ...cube(), meshing: { size: 1e-4 } }),
};

test.each(Object.entries(projects))("%s", async (_, make) => {
  const found = await mesher.checkProject(make());
  const { report } = await mesher.meshProject(make(), { optimization: "none" });
  const isError = ({ severity }: { readonly severity: string }) => severity === "error";
  expect(found.isFillable).toBe(report.status === "done");
  expect(found.diagnostics.filter(isError)).toEqual(report.diagnostics.filter(isError));
  if (!found.isFillable) return;
  // The estimate is within a factor of two.
  const ratio = (found.expectedTetrahedra ?? 0) / report.tetrahedra;
  expect(Math.abs(Math.log2(ratio))).toBeLessThan(1);
});

test("a check is cancelled, and bodies that are prepared are not prepared again", async () => {
  const project = { ...cube(), bodies: [at(3, 1, 1)] };
  const abort = new AbortController();
  const pending = mesher.checkProject(project, {}, { signal: abort.signal });
  abort.abort();
  await expect(pending).rejects.toMatchObject({ code: "cancelled" });
  const preparedBodies = [await mesher.prepareBody(project, 1)];
  const onBody = (): void => expect.unreachable("the body is known");
  const found = await mesher.checkProject(project, { preparedBodies }, { onBody });
  expect(found.isFillable).toBe(true);
});

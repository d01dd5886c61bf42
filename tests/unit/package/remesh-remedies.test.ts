/** Remedies for surfaces that cannot be remeshed name a call that helps. */
import { createMesher, MesherError } from "tetrafront";
import { expect, test } from "vitest";
import { boxSurface } from "../../support/surfaces.js";

test("a surface with a hole is not to be remeshed, but repaired", async () => {
  const { points, triangles } = boxSurface(2);
  const mesher = await createMesher();
  const failure = await mesher
    .remeshSurface({ points, triangles: triangles.slice(3) })
    .catch((thrown: unknown) => thrown);
  mesher.dispose();
  if (!(failure instanceof MesherError)) throw new Error("the surface was remeshed");
  expect(failure.message).toContain("`repairSurface()` closes cracks and holes");
  expect(failure.message).not.toContain('surface: "remesh"');
});

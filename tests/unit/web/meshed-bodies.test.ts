import { createBody, type MeshResult, type Project } from "tetrafront";
import { expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { MeshedBodies } from "../../../web/viewer/meshed-bodies";
import { boxSurface } from "../../support/surfaces";

const bodyOf = (size: number, id = 1) =>
  createBody(boxSurface(1, [0, 0, 0], [size, size, size]), { id, firstPatchId: id });
const withBodies = (...bodies: readonly ReturnType<typeof bodyOf>[]): Project => ({
  ...emptyProject("Test"),
  bodies,
});
const mesh = {} as MeshResult;

it("a mesh is of others once bodies are added, taken away, replaced or moved; sizes and names do not count", () => {
  const [small, large] = [bodyOf(1), bodyOf(2)];
  const meshed = new MeshedBodies();
  const isOther = (project: Project, isMeshStale = true): boolean =>
    meshed.areOthers({ mesh, isMeshStale, project });
  expect(isOther(withBodies(small), false)).toBe(false);
  expect(isOther(withBodies(small))).toBe(false);
  expect(isOther(withBodies({ ...small, name: "part", remeshing: { size: 0.1 } }))).toBe(false);
  expect(isOther(withBodies(small, bodyOf(2, 7)))).toBe(true);
  expect(isOther(withBodies())).toBe(true);
  // The result of another Boolean operation has the same id.
  expect(isOther(withBodies(large))).toBe(true);
  expect(isOther(withBodies({ ...small, placement: { position: [1, 0, 0] } }))).toBe(true);
  expect(isOther(withBodies(small))).toBe(false);
  expect(isOther(withBodies(large), false)).toBe(false);
  expect(isOther(withBodies(small))).toBe(true);
});

it("nothing is known of a mesh that was out of date when it came", () => {
  const meshed = new MeshedBodies();
  expect(meshed.areOthers({ mesh: null, isMeshStale: false, project: withBodies(bodyOf(1)) })).toBe(false);
  expect(meshed.areOthers({ mesh, isMeshStale: true, project: withBodies(bodyOf(2)) })).toBe(false);
  expect(meshed.areOthers({ mesh, isMeshStale: true, project: withBodies() })).toBe(false);
});

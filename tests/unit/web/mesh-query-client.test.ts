import { afterEach, expect, test, vi } from "vitest";

import { MeshQueryClient } from "../../../web/viewer/queries/mesh-query-client.js";
import type { Call } from "../../../web/workers/worker-client.js";
import { gridMesh } from "./grid-mesh";

afterEach(() => vi.unstubAllGlobals());

function recordCalls(): Call[] {
  const posted: Call[] = [];
  vi.stubGlobal(
    "Worker",
    class {
      postMessage(call: Call): void {
        posted.push(call);
      }
      terminate(): void {
        // There is no worker to end.
      }
    },
  );
  return posted;
}

test("a mesh that could not be copied for lack of memory is sent again with the next query", async () => {
  const posted = recordCalls();
  const queries = new MeshQueryClient();
  const mesh = { mesh: gridMesh(1) };
  const part = vi.spyOn(mesh.mesh.points, "subarray").mockImplementationOnce(() => {
    throw new RangeError("no memory");
  });
  await expect(queries.histogram(mesh, "dihedral", "space", 5)).rejects.toThrow("no memory");
  part.mockRestore();
  void queries.histogram(mesh, "dihedral", "space", 5);
  await vi.waitFor(() => expect(posted).toHaveLength(2));
  expect(posted.map(({ name }) => name)).toEqual(["setMesh", "histogram"]);
});

test("meshes are sent one after the other, and each query follows its own", async () => {
  const posted = recordCalls();
  const queries = new MeshQueryClient();
  const [large, small] = [{ mesh: gridMesh(12) }, { mesh: gridMesh(1) }];
  void queries.histogram(large, "dihedral", "space", 5);
  void queries.histogram(large, "dihedral", "space", 6);
  void queries.histogram(small, "dihedral", "space", 7);
  await vi.waitFor(() => expect(posted).toHaveLength(5));
  const told = posted.map(({ name, argument }) =>
    name === "setMesh"
      ? (argument as typeof small).mesh.tetrahedra.length
      : (argument as { readonly barCount: number }).barCount,
  );
  const count = ({ mesh }: typeof small): number => mesh.tetrahedra.length;
  expect(told).toEqual([count(large), 5, 6, count(small), 7]);
});

test("a mesh that is released while it is copied does not stay in the worker", async () => {
  const posted = recordCalls();
  const queries = new MeshQueryClient();
  void queries.histogram({ mesh: gridMesh(2) }, "dihedral", "space", 5);
  queries.release();
  await vi.waitFor(() => expect(posted).toHaveLength(3));
  expect(posted.filter(({ name }) => name === "setMesh").at(-1)?.argument).toBeNull();
});

test("the cut to an element is asked of the worker: the page visits no elements", async () => {
  const posted = recordCalls();
  const queries = new MeshQueryClient();
  const mesh = { mesh: gridMesh(2) };
  void queries.cutTo(mesh, 7, [1, -1, 1]);
  await vi.waitFor(() => expect(posted).toHaveLength(2));
  expect(posted.map(({ name, argument }) => [name, name === "cut" && argument])).toEqual([
    ["setMesh", false],
    ["cut", { element: 7, toEye: [1, -1, 1] }],
  ]);
});

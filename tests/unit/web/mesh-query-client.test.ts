import { afterEach, expect, test, vi } from "vitest";

import { MeshQueryClient } from "../../../web/viewer/queries/mesh-query-client.js";
import type { Call } from "../../../web/workers/worker-client.js";
import { gridMesh } from "./grid-mesh";

afterEach(() => vi.unstubAllGlobals());

test("a mesh that could not be copied for lack of memory is sent again with the next query", async () => {
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
  const queries = new MeshQueryClient();
  const mesh = { volume: gridMesh(1) };
  const slice = vi.spyOn(mesh.volume.points, "slice").mockImplementationOnce(() => {
    throw new RangeError("no memory");
  });
  await expect(queries.histogram(mesh, "dihedral", "space", 5)).rejects.toThrow("no memory");
  slice.mockRestore();
  void queries.histogram(mesh, "dihedral", "space", 5);
  expect(posted.map(({ name }) => name)).toEqual(["setMesh", "histogram"]);
});

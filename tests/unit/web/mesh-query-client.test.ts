import { afterEach, expect, test, vi } from "vitest";
import type { MeshResult } from "tetrafront";

import { MeshLayer } from "../../../web/viewer/layers/mesh-layer.js";
import { MeshQueryClient } from "../../../web/viewer/mesh-query-client.js";
import type { DrawnFaces, QueriedMesh } from "../../../web/viewer/mesh-queries.js";
import type { Call } from "../../../web/workers/worker-client.js";
import { gridMesh } from "./grid-mesh";

afterEach(() => vi.unstubAllGlobals());

test("a mesh that could not be copied for want of memory is sent again with the next query", async () => {
  const posted: Call[] = [];
  vi.stubGlobal(
    "Worker",
    class {
      postMessage(call: Call): void {
        posted.push(call);
      }
      terminate(): void {
        // Nothing runs.
      }
    },
  );
  const queries = new MeshQueryClient();
  const mesh = gridMesh(1);
  const slice = vi.spyOn(mesh.points, "slice").mockImplementationOnce(() => {
    throw new RangeError("no memory");
  });
  await expect(queries.histogram(mesh, "dihedral", 5)).rejects.toThrow("no memory");
  slice.mockRestore();
  void queries.histogram(mesh, "dihedral", 5);
  expect(posted.map(({ name }) => name)).toEqual(["setMesh", "histogram"]);
});

test("after the faces of one mesh failed, the faces of the next mesh are queried", async () => {
  const asked: QueriedMesh[] = [];
  const fail: ((failure: Error) => void)[] = [];
  const queries = {
    facesOf: (mesh: QueriedMesh) => {
      asked.push(mesh);
      return new Promise<DrawnFaces>((_, reject) => fail.push(reject));
    },
  };
  const reasons: string[] = [];
  const onFailure = (reason: string): void => void reasons.push(reason);
  const layer = new MeshLayer(queries as unknown as MeshQueryClient, {
    onChange: () => undefined,
    onFailure,
  });
  const results = [gridMesh(1), gridMesh(2)].map(
    (volume) => ({ volume, report: {} }) as unknown as MeshResult,
  );
  for (const result of results) layer.setMesh(result, [0, 0, 0]);
  fail[0]?.(new Error("no memory"));
  await vi.waitFor(() => expect(reasons).toEqual(["no memory"]));
  layer.refresh();
  expect(asked).toEqual(results.map(({ volume }) => volume));
  // A failed query is not repeated.
  fail[1]?.(new Error("no memory"));
  await vi.waitFor(() => expect(reasons).toHaveLength(2));
  layer.refresh();
  expect(asked).toHaveLength(2);
  expect(layer.isCurrent).toBe(true);
});

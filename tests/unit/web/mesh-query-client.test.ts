import { afterEach, expect, test, vi } from "vitest";
import type { MeshResult } from "tetrafront";

import { MeshLayer } from "../../../web/viewer/layers/mesh-layer.js";
import { MeshSurvey } from "../../../web/viewer/mesh-query-client.js";
import type { DrawnFaces, Surveyed } from "../../../web/viewer/mesh-queries.js";
import type { Request } from "../../../web/viewer/mesh-query-protocol.js";
import { gridMesh } from "./grid-mesh";

afterEach(() => vi.unstubAllGlobals());

test("a mesh for whose copy there was no memory is not taken for that of the worker", async () => {
  const posted: Request[] = [];
  vi.stubGlobal(
    "Worker",
    class {
      postMessage(request: Request): void {
        posted.push(request);
      }
    },
  );
  const survey = new MeshSurvey();
  const mesh = gridMesh(1);
  const slice = vi.spyOn(mesh.points, "slice").mockImplementationOnce(() => {
    throw new RangeError("no memory");
  });
  await expect(survey.histogram(mesh, "dihedral", 5)).rejects.toThrow("no memory");
  slice.mockRestore();
  void survey.histogram(mesh, "dihedral", 5);
  expect(posted.map(({ kind }) => kind)).toEqual(["mesh", "question"]);
});

test("where the faces of one mesh cannot be found, those of the mesh wanted since are asked for", async () => {
  const asked: Surveyed[] = [];
  const fail: ((failure: Error) => void)[] = [];
  const survey = {
    facesOf: (mesh: Surveyed) => {
      asked.push(mesh);
      return new Promise<DrawnFaces>((_, reject) => fail.push(reject));
    },
  };
  const reasons: string[] = [];
  const onFailure = (reason: string): void => void reasons.push(reason);
  const layer = new MeshLayer(survey as unknown as MeshSurvey, { onChange: () => undefined, onFailure });
  const results = [gridMesh(1), gridMesh(2)].map(
    (volume) => ({ volume, report: {} }) as unknown as MeshResult,
  );
  for (const result of results) layer.setMesh(result, [0, 0, 0]);
  fail[0]?.(new Error("no memory"));
  await vi.waitFor(() => expect(reasons).toEqual(["no memory"]));
  layer.refresh();
  expect(asked).toEqual(results.map(({ volume }) => volume));
  // Of what has failed nothing more is asked.
  fail[1]?.(new Error("no memory"));
  await vi.waitFor(() => expect(reasons).toHaveLength(2));
  layer.refresh();
  expect(asked).toHaveLength(2);
  expect(layer.isCurrent).toBe(true);
});

/** Isosurfaces and arrows of a field in the view, and what gives way to them. */
import type { Mesh, MeshResult } from "tetrafront";
import { describe, expect, it } from "vitest";
import { createStore } from "zustand/vanilla";
import { DocumentStore } from "../../../web/session/document-store";
import { MeshRun } from "../../../web/session/run";
import { Solutions } from "../../../web/session/solutions";
import { FieldView } from "../../../web/viewer/field-view";
import { FieldLayer } from "../../../web/viewer/layers/field-layer";
import type { MeshQueryClient } from "../../../web/viewer/queries/mesh-query-client";
import { drawsIsosurface } from "../../../web/viewer/scene-state";
import { cubeProject } from "../../support/projects";
import { gridMesh } from "./grid-mesh";
import { sceneState, show } from "./scene";

const grid = gridMesh(2);
const heights = Float64Array.from({ length: grid.points.length / 3 }, (_, n) => grid.points[3 * n + 2] ?? 0);
const nodeData: Mesh["nodeData"] = new Map([["height", { components: 1, values: heights }]]);

/** Solutions whose shown mesh has one field, from 0 to 2, which is shown. */
function shownHeights() {
  const documents = new DocumentStore(cubeProject());
  const run = new MeshRun(documents, new Promise(() => undefined));
  const solutions = new Solutions(documents, run);
  const mesh = { mesh: { ...grid, nodeData } } as unknown as MeshResult;
  run.state.setState({ mesh });
  solutions.choose({ name: "height", component: 0, label: "height" });
  return { solutions, mesh };
}

/** Lets promises that have resolved go on. */
const turn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

it("isosurfaces are queried one at a time, the last value after the one under way", async () => {
  const { solutions } = shownHeights();
  const levels: number[] = [];
  const answers: (() => void)[] = [];
  const meshQueries: Pick<MeshQueryClient, "isosurface"> = {
    isosurface: (_mesh, _field, level) => {
      levels.push(level);
      return new Promise((resolve) => answers.push(() => resolve(new Float32Array(9))));
    },
  };
  new FieldView({ solutions, meshQueries, viewer: createStore(() => ({ viewer: null })) });
  for (const isosurface of [0.25, 0.5, 0.75, 1]) solutions.setShapes({ isosurface });
  expect(levels).toEqual([0.5]);
  answers.shift()?.();
  await turn();
  expect(levels).toEqual([0.5, 2]);
  answers.shift()?.();
  await turn();
  expect(levels).toHaveLength(2);
  solutions.setShapes({ isosurface: 0.5 });
  expect(levels).toEqual([0.5, 2, 1]);
});

describe("the surfaces of the mesh", () => {
  const { solutions, mesh } = shownHeights();
  const meshed = sceneState({ mesh, shownField: solutions.state.getState().shown });

  it("give way to an isosurface, and the layers that the user has chosen stay", () => {
    expect(drawsIsosurface(meshed)).toBe(false);
    expect(drawsIsosurface({ ...meshed, hasIsosurface: true })).toBe(true);
  });

  it("are drawn while a front or another mesh is, without shapes of the field", () => {
    const layer = new FieldLayer();
    const inside = { ...meshed, hasIsosurface: true };
    const front = { ...inside, front: new Float64Array(9) };
    const others = { ...inside, isMeshOfOthers: true };
    const replaced = { ...inside, unoptimized: { mesh: { ...mesh.mesh, tetrahedra: new Uint32Array(4) } } };
    const visible = [inside, front, others, replaced, inside].map((state) => {
      show(layer, state);
      return layer.root.visible;
    });
    expect(visible).toEqual([true, false, false, false, true]);
    layer.dispose();
  });
});

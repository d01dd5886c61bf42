import { afterAll, beforeAll, expect, it, vi } from "vitest";
import { createMesher, type Mesher, type MeshResult, readSurface } from "tetrafront";
import { createBodies } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { DocumentStore } from "../../../web/session/document-store";
import { MeshRun } from "../../../web/session/run";
import { SecondOrder } from "../../../web/session/second-order";
import { untilState } from "../../../web/session/until-state";
import { drilledSolid, stepFile } from "../../support/step-files";

let mesher: Mesher;
let run: MeshRun;
let secondOrder: SecondOrder;
beforeAll(async () => {
  mesher = await createMesher();
  const plate = stepFile([drilledSolid("Plate", [0, 0, 0], [20, 10, 8], [8, 5], 3)]);
  const read = await readSurface(plate, { fileName: "plate.step" });
  if (!read.success) throw new Error("the plate cannot be read");
  const bodies = createBodies(read.value, { id: 1, firstPatchId: 1, name: "plate" });
  const project = { ...emptyProject("plate"), bodies, meshing: { optimization: "none" } as const };
  run = new MeshRun(new DocumentStore(project), Promise.resolve(mesher));
  secondOrder = new SecondOrder(run, Promise.resolve(mesher));
  await run.generate();
});
afterAll(() => mesher.dispose());

const shown = (): MeshResult => {
  const { mesh } = run.state.getState();
  if (!mesh) throw new Error("there is no mesh");
  return mesh;
};

/** Returns the number of curved edges between nodes of the surface's triangles; untangling may curve others inside. */
function curvedOnSurface({ mesh: { triangles, curvedEdges } }: MeshResult): number {
  const sides = new Set<string>();
  triangles.forEach((node, corner) => {
    const next = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? node;
    sides.add(`${Math.min(node, next)} ${Math.max(node, next)}`);
  });
  const { edges = new Uint32Array() } = curvedEdges ?? {};
  return edges.filter((node, i) => {
    const other = edges[i + 1] ?? node;
    return i % 2 === 0 && sides.has(`${Math.min(node, other)} ${Math.max(node, other)}`);
  }).length;
}

const curvedShown = () => untilState(run.state, ({ mesh }) => mesh?.report.secondOrder !== undefined);

it("curves the shown mesh while it is on, and the next one", async () => {
  const straight = shown();
  expect(straight.mesh.curvedEdges).toBeUndefined();
  secondOrder.setOn(true);
  await curvedShown();
  const curved = shown();
  expect(curved.mesh.curvedEdges?.edges.length).toBeGreaterThan(50);
  expect(curved.report).toMatchObject({ tetrahedra: straight.report.tetrahedra });
  expect(curved.report.secondOrder?.minScaledJacobian).toBeLessThan(1);
  // Warnings of the outcome belong to the shown mesh.
  expect(run.state.getState().outcome?.result).toBe(curved);
  expect(await secondOrder.curved(curved)).toBe(curved);
  expect(await secondOrder.curved(straight)).toBe(curved);

  secondOrder.setOn(false);
  expect(shown()).toBe(straight);
  secondOrder.setOn(true);
  await run.generate();
  await curvedShown();
  expect(shown()).not.toBe(curved);
});

it("an improved mesh is curved again", async () => {
  const before = shown();
  expect(await run.improve()).toMatchObject({ kind: "shown", improvement: { isImproved: true } });
  await curvedShown();
  expect(shown()).not.toBe(before);
  expect(shown().report.secondOrder).toBeDefined();
  expect(curvedOnSurface(shown())).toBe(curvedOnSurface(before));
  expect(curvedOnSurface(before)).toBeGreaterThan(50);
});

it("is remembered by the browser for the next session", () => {
  const kept = new Map<string, string>();
  vi.stubGlobal("localStorage", {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
    removeItem: (key: string) => void kept.delete(key),
  });
  const next = (): SecondOrder =>
    new SecondOrder(
      new MeshRun(new DocumentStore(emptyProject()), Promise.resolve(mesher)),
      Promise.resolve(mesher),
    );
  expect(next().state.getState().isOn).toBe(false);
  next().setOn(true);
  expect(next().state.getState().isOn).toBe(true);
  next().setOn(false);
  expect(next().state.getState().isOn).toBe(false);
  vi.unstubAllGlobals();
});

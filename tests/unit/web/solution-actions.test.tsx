// @vitest-environment happy-dom
/** What the panel of solutions does when it has no mesh, and what its fields change. */
import { MantineProvider } from "@mantine/core";
import type { Mesher } from "tetrafront";
import { patchNames } from "tetrafront/internal";
import { readProject, writeProject } from "tetrafront/project";
import { act } from "react";
import { beforeEach, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import { setUpProblem, showFieldShapes, solveInCycles } from "../../../web/commands/solution-actions";
import { ConditionList } from "../../../web/panels/solution/condition-list";
import { AppContext } from "../../../web/panels/shared/app-context";
import { documentKey, meshKey } from "../../../web/document/content-keys";
import { renameEntity } from "../../../web/document/edits";
import { newDocument } from "../../../web/session/document-store";
import {
  defaultCondition,
  defaultSetup,
  problemWith,
  setupIn,
  type ProblemSetup,
} from "../../../web/session/problem-setup";
import { solutionStrings as texts } from "../../../web/strings/solution";
import { cubeProject } from "../../support/projects";
import { rootPerTest } from "../../support/react-root";
import { SilentWorker } from "../../support/silent-worker";

const render = rootPerTest();

/** A mesher that never answers. */
const busyMesher = Promise.resolve({
  previewProject: () => new Promise(() => undefined),
} as unknown as Mesher);

const settings = { cycles: 0, elements: 100, norm: "l2" } as const;

let app: App;

beforeEach(() => {
  vi.stubGlobal("Worker", SilentWorker);
  const first = { document: newDocument(cubeProject()) };
  app = new App(
    { first, mesher: busyMesher, previewMesher: busyMesher, library: null },
    { gallery: { opening: "", models: [] }, generate: false, still: true },
  );
});

it("Solve generates a mesh as the command does, and says so if none is made", async () => {
  const generate = vi.spyOn(app.run, "generate").mockResolvedValue();
  const adapt = vi.spyOn(app.run, "adapt");
  app.view.setLayer("mesh", false);
  await solveInCycles(app, settings);
  expect(generate).toHaveBeenCalledOnce();
  expect(app.view.state.getState().layers.mesh).toBe(true);
  expect(app.solutions.state.getState().failure).toBe(texts.noMesh);
  expect(adapt).not.toHaveBeenCalled();
});

it("Solve does nothing to a document that is opened while it waits for the mesh", async () => {
  const adapt = vi.spyOn(app.run, "adapt");
  vi.spyOn(app.run, "generate").mockImplementation(() => {
    app.documents.show(newDocument(cubeProject()));
    return Promise.resolve();
  });
  await solveInCycles(app, settings);
  expect(app.solutions.state.getState().failure).toBeNull();
  expect(adapt).not.toHaveBeenCalled();
});

it("an isosurface leaves the layers as the user has chosen them", () => {
  app.view.setLayer("bodies", false);
  const { layers } = app.view.state.getState();
  showFieldShapes(app, { isosurface: 0.5 });
  expect(app.view.state.getState().layers).toEqual(layers);
  showFieldShapes(app, { isosurface: null });
  expect(app.view.state.getState().layers).toEqual(layers);
});

it("the problem is part of the project: undo, names and removed patches", () => {
  const { documents } = app;
  const setup = (): ProblemSetup => setupIn(documents.project);
  const before = documents.project;
  const [first = "", second = ""] = patchNames(before);
  const conditions = [
    { ...defaultCondition("heat", first), value: 20 },
    defaultCondition("elasticity", first),
    { ...defaultCondition("heat", second), kind: "flux" as const, value: -3 },
  ];
  const stated = { ...defaultSetup, source: 4, conditions };
  setUpProblem(app, stated);
  expect(setup()).toEqual(stated);
  expect(readProject(writeProject(documents.project))).toEqual({ success: true, value: documents.project });
  // The file differs, the mesh does not.
  expect(documentKey(documents.project)).not.toBe(documentKey(before));
  expect(meshKey(documents.project)).toBe(meshKey(before));
  const other = { ...stated, conditions: conditions.map((one) => ({ ...one, value: one.value + 1 })) };
  const changed = { ...documents.project, problem: problemWith(other, documents.project) };
  expect(documentKey(changed)).not.toBe(documentKey(documents.project));

  const [patch] = before.patches;
  documents.edit(renameEntity({ kind: "patch", id: patch?.id ?? 0 }, "hot"));
  expect(setup().conditions[0]).toEqual({ ...conditions[0], patch: "hot" });
  documents.edit({ label: "", change: (draft) => void draft.project.patches.shift() });
  expect(setup().conditions).toEqual([conditions[2]]);
  documents.undo();
  expect(setup().conditions).toHaveLength(3);
  documents.undo();
  documents.undo();
  expect(documents.project.problem).toBeUndefined();
});

it("removing a condition keeps those of the other kind of problem", () => {
  const fixed = defaultCondition("elasticity", "a");
  const warm = defaultCondition("heat", "a");
  const cold = defaultCondition("heat", "b");
  const changes: Partial<ProblemSetup>[] = [];
  render(
    <MantineProvider>
      <AppContext value={app}>
        <ConditionList
          setup={{ ...defaultSetup, conditions: [warm, fixed, cold] }}
          onChange={(part) => void changes.push(part)}
        />
      </AppContext>
    </MantineProvider>,
  );
  const button = document.querySelector<HTMLElement>(`[aria-label="${texts.remove("b")}"]`);
  act(() => button?.click());
  expect(changes).toEqual([{ conditions: [fixed, warm] }]);
});

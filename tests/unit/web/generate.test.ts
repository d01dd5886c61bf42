/** What "Generate mesh" does to bodies before the run. */
import type { Mesher, MeshResult } from "tetrafront";
import { createBody, type ProjectBody } from "tetrafront/project";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import { generateMesh } from "../../../web/commands/mesh-actions";
import { newProject } from "../../../web/commands/project-actions";
import { setBodySurface } from "../../../web/document/body-edits";
import { emptyProject } from "../../../web/document/create";
import type { RepairProposal } from "../../../web/document/body-repair";
import { pieceOperations } from "../../../web/document/operations/pieces";
import type { BodyState } from "../../../web/session/bodies";
import { newDocument } from "../../../web/session/document-store";
import { showNotice } from "../../../web/session/shell";
import { boxSurface } from "../../support/surfaces";
import { SilentWorker } from "../../support/silent-worker";

/** A mesher that never answers. */
const busyMesher = Promise.resolve({
  previewProject: () => new Promise(() => undefined),
  inspectSurface: () => new Promise(() => undefined),
} as unknown as Mesher);

const bodies = [1, 2, 3].map((id) =>
  createBody(boxSurface(1), { id, firstPatchId: 10 * id, name: `box ${id}` }),
);

let app: App;

beforeEach(() => {
  vi.stubGlobal("Worker", SilentWorker);
  const first = { document: newDocument({ ...emptyProject("a"), bodies }) };
  app = new App(
    { first, mesher: busyMesher, previewMesher: busyMesher, library: null },
    { gallery: { opening: "", models: [] }, generate: false, still: true },
  );
});

/** Each body has a hole, and a repair is known that fills it. */
function proposeRepairs(): void {
  const none = new Uint32Array();
  const surface = { points: new Float64Array(), triangles: none, trianglePatch: none };
  const repair = { after: { isFillable: true }, changes: [], shared: 0, surface, hasFilled: false };
  const byId = new Map(app.bodies.state.getState().byId);
  for (const [id, state] of byId) {
    byId.set(id, {
      ...state,
      inspection: { isFillable: false, diagnostics: [] as const } as unknown as BodyState["inspection"],
      repair: repair as unknown as RepairProposal,
    });
  }
  app.bodies.state.setState({ byId });
}

/** Stands in for the worker: returns a body with other triangles. */
function repairTo(onRepair: () => void) {
  return vi.spyOn(app.bodies, "replaced").mockImplementation((body: ProjectBody) => {
    onRepair();
    return Promise.resolve({ ...body, triangles: `${body.triangles} ` });
  });
}

const steps = () => app.documents.state.getState().history.past.map(({ label }) => label);
const log = () => app.run.state.getState().log.map(({ text }) => text);

it("lets notes about the file and the earlier mesh give way, and keeps others", async () => {
  const keys = ["file-notes", "improvement", "document-left"] as const;
  const action = { label: "OK", run: () => undefined };
  for (const key of keys) showNotice(app.shell, { key, tone: "information", text: key, action });
  const run = generateMesh(app);
  expect(app.shell.getState().notices.map(({ key }) => key)).toEqual(["document-left"]);
  app.run.cancel();
  await run;
});

it("lets notes about the file give way when the treatment of a body is changed", () => {
  const action = { label: "OK", run: () => undefined };
  showNotice(app.shell, { key: "file-notes", tone: "information", text: "keeps them", action });
  app.documents.edit(setBodySurface(1, "keep"));
  expect(app.shell.getState().notices).toEqual([]);
});

it("lets notices about a document give way when another one is opened", () => {
  const action = { label: "OK", run: () => undefined };
  for (const key of ["file-notes", "deleted", "note", "worker"] as const)
    showNotice(app.shell, { key, tone: "information", text: key, action });
  newProject(app);
  expect(app.shell.getState().notices.map(({ key }) => key)).toEqual(["worker"]);
});

it("meshes what an open operation shows, and closes one that gives nothing", async () => {
  const [box] = pieceOperations;
  if (!box) throw new Error("there is no operation");
  app.operations.start(box);
  const run = generateMesh(app);
  expect(app.operations.state.getState().open).toBeNull();
  expect(steps()).toEqual([box.step]);
  app.run.cancel();
  await run;
  app.documents.undo();
  app.operations.start({ ...box, make: () => ({ possible: false, reason: "no size" }) });
  const other = generateMesh(app);
  expect(app.operations.state.getState().open).toBeNull();
  expect(steps()).toEqual([]);
  app.run.cancel();
  await other;
});

it("is cancelled while it waits for the end of a gesture", async () => {
  vi.spyOn(app.bodies, "settled").mockResolvedValue();
  const run = generateMesh(app);
  app.documents.begin("Drag");
  await vi.waitFor(() => expect(app.run.state.getState().preparing).toBe("Joining bodies that touch"));
  app.run.cancel();
  await run;
  expect(log()).toEqual(["Cancelled before anything was meshed"]);
});

it("waits until all bodies are inspected, and is cancelled meanwhile", async () => {
  const repair = repairTo(() => undefined);
  const run = generateMesh(app);
  await vi.waitFor(() => expect(app.run.state.getState().preparing).toBe("Inspecting bodies"));
  app.run.cancel();
  await run;
  expect(repair).not.toHaveBeenCalled();
  expect(log()).toEqual(["Cancelled before anything was meshed"]);
});

it("waits for a preview of the present content, whose progress it shows, and aborts others", async () => {
  const ends = new Map<number, (fraction: number) => void>();
  const aborted: number[] = [];
  const mesher = {
    ...(await busyMesher),
    prepareBody: (
      _project: unknown,
      id: number,
      _options: unknown,
      control: { signal: AbortSignal; onProgress: (progress: { fraction: number }) => void },
    ) =>
      new Promise((_, reject) => {
        control.signal.addEventListener("abort", () => {
          aborted.push(id);
          reject(new Error("aborted"));
        });
        ends.set(id, (fraction) =>
          fraction < 1 ? control.onProgress({ fraction }) : reject(new Error("cannot be prepared")),
        );
      }),
  } as unknown as Mesher;
  const first = { document: newDocument({ ...emptyProject("a"), bodies }) };
  const made = new App(
    { first, mesher: busyMesher, previewMesher: Promise.resolve(mesher), library: null },
    { gallery: { opening: "", models: [] }, generate: false, still: true },
  );
  void made.bodies.prepare(1);
  void made.bodies.prepare(2);
  await vi.waitFor(() => expect([...ends.keys()]).toEqual([1, 2]));
  // The second body is another one now: its preview is out of date.
  const [box, second, ...others] = bodies;
  const moved = { ...second, triangles: `${second?.triangles} ` } as unknown as ProjectBody;
  made.documents.edit({
    label: "Move",
    replace: { bodies: [box, moved, ...others].flatMap((body) => body ?? []) },
  });
  const fractions: number[] = [];
  let isOver = false;
  const waiting = made.bodies.previewed(new AbortController().signal, (fraction) => fractions.push(fraction));
  void waiting.then(() => (isOver = true));
  await vi.waitFor(() => expect(aborted).toContain(2));
  ends.get(1)?.(0.5);
  expect(fractions.at(-1)).toBe(0.5);
  await Promise.resolve();
  expect(isOver).toBe(false);
  ends.get(1)?.(1);
  await waiting;
});

it("repairs no further body after it was cancelled", async () => {
  proposeRepairs();
  const repair = repairTo(() => app.run.cancel());
  await generateMesh(app);
  expect(repair).toHaveBeenCalledOnce();
  expect(steps()).toHaveLength(1);
  expect(app.run.state.getState()).toMatchObject({ busy: false, preparing: null });
  expect(log()).toEqual(["Cancelled before anything was meshed"]);
});

it("repairs all bodies, each as a step of undo, before they are inspected again", async () => {
  proposeRepairs();
  const repair = repairTo(() => undefined);
  const run = generateMesh(app);
  await vi.waitFor(() => expect(steps()).toHaveLength(bodies.length));
  expect(repair).toHaveBeenCalledTimes(bodies.length);
  await vi.waitFor(() => expect(app.run.state.getState().preparing).toBe("Inspecting bodies"));
  // A second command waits for the same run.
  void generateMesh(app);
  expect(app.run.state.getState().busy).toBe(true);
  app.run.cancel();
  await run;
  expect(steps()).toHaveLength(bodies.length);
});

describe("the mesh just made", () => {
  /** Stands in for a run that ends with a status. */
  const endRun = (status: "done" | "cancelled"): void => {
    vi.spyOn(app.run, "generate").mockImplementation(() => {
      const result = { report: { status } } as unknown as MeshResult;
      app.run.state.setState({ outcome: { key: "a", result, expectedTetrahedra: 0, warnings: [] } });
      return Promise.resolve();
    });
  };
  const isCovered = (): readonly [selected: number, sizes: boolean] => {
    const { selection, sizes } = app.view.state.getState();
    return [selection.length, sizes.enabled];
  };

  beforeEach(() => {
    app.view.select({ kind: "body", id: 1 });
    app.view.setSizes({ enabled: true });
  });

  it("is seen as such: nothing is selected, and no target sizes cover it", async () => {
    endRun("done");
    await generateMesh(app);
    expect(isCovered()).toEqual([0, false]);
  });

  it("leaves the selection and the sizes if there is no mesh", async () => {
    endRun("cancelled");
    await generateMesh(app);
    expect(isCovered()).toEqual([1, true]);
  });
});

import { describe, expect, it, vi } from "vitest";
import {
  createMesher,
  type Mesher,
  type ProgressPhase,
  type PreparedBody,
  type CallProgress,
  type RunControl,
} from "tetrafront";
import { createBody } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { meshKey, versionedKey } from "../../../web/document/content-keys";
import { DocumentStore, newDocument } from "../../../web/session/document-store";
import { MeshRun } from "../../../web/session/run";
import { canImprove, isOfOtherBodies, isStale } from "../../../web/session/run-state";
import { cancelledText, type LogLine } from "../../../web/session/run-log";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";

const report = (phase: ProgressPhase, elapsedSeconds: number): CallProgress => ({
  phase,
  fraction: 0,
  nodes: 0,
  triangles: 0,
  tetrahedra: 0,
  frontFaces: 0,
  expectedTetrahedra: 0,
  exactFillFraction: 0,
  elapsedSeconds,
});

/** Runs with these progress reports and without a result. Returns the reports that the page shows, and the log. */
async function shownAndLogged(
  reports: readonly CallProgress[],
): Promise<[CallProgress[], readonly LogLine[]]> {
  const real = await createMesher();
  const mesher: Mesher = Object.assign(Object.create(real) as Mesher, {
    meshProject: (
      _project: unknown,
      _options: unknown,
      control: { onProgress: (p: CallProgress) => void },
    ) => {
      for (const progress of reports) control.onProgress(progress);
      return real.meshProject(emptyProject("nothing"));
    },
  });
  const run = new MeshRun(new DocumentStore(emptyProject("nothing")), Promise.resolve(mesher));
  const states: CallProgress[] = [];
  run.state.subscribe(({ progress }, before) => {
    if (progress && progress !== before.progress) states.push(progress);
  });
  await run.generate();
  real.dispose();
  return [states, run.state.getState().log];
}

const shown = async (reports: readonly CallProgress[]): Promise<CallProgress[]> =>
  (await shownAndLogged(reports))[0];

describe("the progress of a run", () => {
  it("is shown at longer intervals in a long run, but at most 1.1 s apart", async () => {
    const reports = Array.from({ length: 1000 }, (_, i) => report("optimize", 0.1 * i));
    const states = await shown(reports);
    expect(states.length).toBeLessThan(200);
    states.slice(1).forEach(({ elapsedSeconds }, i) => {
      const wait = elapsedSeconds - (states[i]?.elapsedSeconds ?? 0);
      expect(wait).toBeLessThanOrEqual(1.1);
      expect(wait).toBeGreaterThanOrEqual(Math.min(1, 0.04 * elapsedSeconds) - 1e-9);
    });
  });

  it("is shown immediately when a phase begins", async () => {
    const phases: readonly ProgressPhase[] = ["check", "sides", "surface", "volume", "optimize", "verify"];
    const reports = phases.flatMap((phase, i) => [
      report(phase, 50 + i / 100),
      report(phase, 50.001 + i / 100),
    ]);
    expect((await shown(reports)).map(({ phase }) => phase)).toEqual(phases);
  });

  it("is logged with the times of the run, however late its messages arrive", async () => {
    const [, log] = await shownAndLogged([report("check", 1), report("sides", 20), report("optimize", 300)]);
    expect(log.slice(0, 4).map(({ seconds }) => seconds)).toEqual([0, 1, 20, 300]);
    // The last entry has the time of the run's own report.
    expect(log.at(-1)?.seconds).toBeLessThan(1);
  });
});

describe("the picture of a run", () => {
  it("is the last front until the mesh to be optimized replaces it, and that mesh until the end", async () => {
    const real = await createMesher();
    const front = new Float64Array(9);
    const unoptimized = await real.meshProject(emptyProject("nothing"));
    const pictures: unknown[] = [];
    const mesher: Mesher = Object.assign(Object.create(real) as Mesher, {
      meshProject: (_project: unknown, _options: unknown, control: RunControl) => {
        const shownNow = (): unknown[] => {
          const state = run.state.getState();
          return [state.front, state.unoptimized];
        };
        control.onFront?.(front);
        control.onProgress?.(report("volume", 1));
        control.onProgress?.(report("optimize", 2));
        pictures.push(shownNow());
        control.onUnoptimized?.(unoptimized.mesh);
        control.onProgress?.(report("verify", 3));
        pictures.push(shownNow());
        return Promise.resolve(unoptimized);
      },
    });
    const run = new MeshRun(new DocumentStore(emptyProject("nothing")), Promise.resolve(mesher));
    await run.generate();
    real.dispose();
    expect(pictures).toEqual([
      [front, null],
      [null, { mesh: unoptimized.mesh }],
    ]);
    expect(run.state.getState()).toMatchObject({ front: null, unoptimized: null });
  });
});

/** Runs of a cube with a mesher whose improvement ends when `finish` is called, with a better mesh. */
async function improvable(meshVersion?: string) {
  const real = await createMesher();
  const project = cubeProject();
  let finish = (): void => undefined;
  const finished = new Promise<void>((resolve) => (finish = resolve));
  const mesher: Mesher = Object.assign(Object.create(real) as Mesher, {
    meshProject: (...given: Parameters<Mesher["meshProject"]>) => real.meshProject(...given),
    inspectMesh: (...given: Parameters<Mesher["inspectMesh"]>) => real.inspectMesh(...given),
    improveMesh: async (...given: Parameters<Mesher["improveMesh"]>) => {
      const [mesh, options, control] = given;
      await Promise.race([
        finished,
        new Promise<void>((resolve) => {
          if (control?.signal?.aborted === true) resolve();
          else control?.signal?.addEventListener("abort", () => resolve());
        }),
      ]);
      const found = await real.improveMesh(mesh, options);
      return { ...found, isImproved: true };
    },
  });
  const documents = new DocumentStore(project);
  if (meshVersion !== undefined) {
    documents.show(newDocument(project, null, versionedKey(meshKey(project), meshVersion)));
  }
  const run = new MeshRun(documents, Promise.resolve(mesher));
  const steps = (): string[] => documents.state.getState().history.past.map(({ label }) => label);
  const stale = (): boolean => isStale(run.state.getState(), documents.state.getState());
  return { documents, run, steps, stale, finish, project, dispose: () => real.dispose() };
}

/** Resolves when all promises that were resolved before have called what waits for them. */
const nextTask = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

const renamed = (name: string) => ({ label: "Rename", replace: { name } }) as const;

describe("an improvement", () => {
  it("is discarded if the model changes meanwhile, but not if it is only renamed", async () => {
    const { documents, run, steps, stale, finish, dispose } = await improvable();
    await run.generate();
    const first = run.improve();
    documents.edit({ label: "Refine", replace: { meshing: { size: 0.4 } } });
    finish();
    expect(await first).toEqual({ kind: "discarded" });
    expect(steps()).toEqual(["Refine"]);
    documents.undo();
    const second = run.improve();
    documents.edit(renamed("another name"));
    expect(await second).toMatchObject({ kind: "shown", improvement: { isImproved: true } });
    expect(steps()).toEqual(["Rename", "Improve mesh"]);
    expect(documents.project.name).toBe("another name");
    expect(stale()).toBe(false);
    expect(run.state.getState()).toMatchObject({ isValid: true, improvement: { isImproved: true } });
    documents.undo();
    expect(run.state.getState()).toMatchObject({ isValid: null, improvement: null });
    dispose();
  });

  it("that ends during a drag waits for its end, and the drag stays one step", async () => {
    const { documents, run, steps, finish, dispose } = await improvable();
    await run.generate();
    const afterGesture = documents.afterGesture.bind(documents);
    const waits = new Promise<void>((resolve) => {
      vi.spyOn(documents, "afterGesture").mockImplementation(() => {
        resolve();
        return afterGesture();
      });
    });
    const improving = run.improve();
    const drag = documents.begin("Drag");
    drag.update(renamed("half-way"));
    finish();
    // Either the improvement waits for the drag, or it ends too early.
    await Promise.race([improving, waits]);
    await nextTask();
    expect(steps()).toEqual([]);
    drag.update(renamed("at the end"));
    drag.commit();
    expect(await improving).toMatchObject({ kind: "shown" });
    expect(steps()).toEqual(["Drag", "Improve mesh"]);
    expect(documents.project.name).toBe("at the end");
    dispose();
  });

  it("is kept longer than meshes that a run can make again", async () => {
    const { documents, run, stale, finish, dispose } = await improvable();
    await run.generate();
    finish();
    await run.improve();
    for (let k = 0; k < 8; ++k) {
      documents.edit({ label: "Size", replace: { meshing: { size: 0.4 + k / 100 } } });
      await run.generate();
    }
    for (let k = 0; k < 8; ++k) documents.undo();
    expect(run.state.getState().improvement?.isImproved).toBe(true);
    expect(stale()).toBe(false);
    dispose();
  });

  it("is impossible for a stretched mesh, which it would measure in space", async () => {
    const { documents, run, dispose } = await improvable();
    await run.generate();
    const { mesh } = run.state.getState();
    expect(canImprove(run.state.getState(), documents.state.getState())).toBe(true);
    const shapes = { radiusRatio: new Float32Array(), smallestDihedral: new Float32Array() };
    run.state.setState({ mesh: mesh && { ...mesh, metricShapes: shapes } });
    expect(canImprove(run.state.getState(), documents.state.getState())).toBe(false);
    expect(await run.improve()).toBeNull();
    dispose();
  });
});

describe("a run of a project whose own mesh is no longer kept", () => {
  it("is a step of undo if the user has asked for it", async () => {
    const { run, steps, stale, dispose } = await improvable("lost");
    await run.generate();
    expect([steps(), stale()]).toEqual([["Generate mesh"], false]);
    dispose();
  });

  it("leaves the steps of undo and redo if the app has asked for it", async () => {
    const { documents, run, steps, stale, dispose } = await improvable("lost");
    documents.edit(renamed("first"));
    documents.edit(renamed("second"));
    documents.undo();
    await run.generate("app");
    expect([steps(), stale()]).toEqual([["Rename"], false]);
    documents.redo();
    expect([documents.project.name, stale()]).toEqual(["second", false]);
    dispose();
  });
});

it("a run says what became of each body, and leaves it as its preview", async () => {
  const mesher = await createMesher();
  const project = {
    ...emptyProject("a"),
    bodies: [createBody(boxSurface(2), { id: 1, firstPatchId: 1, name: "box" })],
  };
  const kept: PreparedBody[] = [];
  let known: readonly PreparedBody[] = [];
  const run = new MeshRun(new DocumentStore(project), Promise.resolve(mesher), {
    allOf: () => known,
    keep: (_, prepared) => void kept.push(prepared),
  });
  const texts = () => run.state.getState().log.map(({ text }) => text);
  await run.generate("user", () => Promise.resolve([{ level: "information", text: "box, repaired" }]));
  expect(kept).toHaveLength(1);
  const count = ((kept[0]?.triangles.length ?? 0) / 3).toLocaleString("en-US");
  const line = texts().find((text) => text.startsWith("box: remeshed"));
  expect(line).toContain(`remeshed to ${count} triangles, sizes`);
  expect(line).toMatch(/smallest angle \d+\.\d°, mean 2r\/R 0\.\d+, deviation at most/);
  expect(texts()[1]).toBe("box, repaired");
  known = kept.slice();
  await run.generate();
  expect(kept).toHaveLength(1);
  expect(texts()).toContain(line);
  mesher.dispose();
});

const bodyOf = (size: number, id = 1) =>
  createBody(boxSurface(1, [0, 0, 0], [size, size, size]), { id, firstPatchId: id });
const movedTo = (body: ReturnType<typeof bodyOf>, x: number) => ({
  ...body,
  placement: { position: [x, 0, 0] as const },
});

it("a mesh is of others once bodies are added, removed, replaced or moved; sizes, names and order do not count", async () => {
  const mesher = await createMesher();
  const [small, large, apart] = [bodyOf(1), bodyOf(2), movedTo(bodyOf(1, 7), 5)];
  const documents = new DocumentStore({ ...emptyProject("a"), bodies: [small, apart] });
  const run = new MeshRun(documents, Promise.resolve(mesher));
  const isOther = (): boolean => isOfOtherBodies(run.state.getState(), documents.state.getState());
  const isOtherWith = (...bodies: readonly ReturnType<typeof bodyOf>[]): boolean => {
    documents.edit({ label: "Bodies", replace: { bodies } });
    return isOther();
  };
  expect(isOther()).toBe(false);
  await run.generate();
  expect(isOther()).toBe(false);
  expect(isOtherWith({ ...small, name: "part", remeshing: { size: 0.1 } }, apart)).toBe(false);
  expect(isOtherWith(apart, small)).toBe(false);
  expect(isOtherWith(small)).toBe(true);
  expect(isOtherWith(small, apart, bodyOf(1, 9))).toBe(true);
  // The result of another Boolean operation has the same id.
  expect(isOtherWith(large, apart)).toBe(true);
  documents.undo();
  expect(isOtherWith(movedTo(small, 9), apart)).toBe(true);
  documents.jumpTo(0);
  expect(isOther()).toBe(false);
  expect(isStale(run.state.getState(), documents.state.getState())).toBe(false);
  const drag = documents.begin("Move");
  drag.update({
    replace: { bodies: [small, movedTo(apart, 6)] },
  });
  expect(isOther()).toBe(true);
  drag.cancel();
  expect(isOther()).toBe(false);
  mesher.dispose();
});

it("a mesh of a body that was moved while the run was under way is of others", async () => {
  const mesher = await createMesher();
  const body = bodyOf(1);
  const documents = new DocumentStore({ ...emptyProject("a"), bodies: [body] });
  const run = new MeshRun(documents, Promise.resolve(mesher));
  const running = run.generate();
  documents.edit({ label: "Move", replace: { bodies: [movedTo(body, 3)] } });
  await running;
  expect(run.state.getState().mesh?.report.status).toBe("done");
  expect(isOfOtherBodies(run.state.getState(), documents.state.getState())).toBe(true);
  documents.undo();
  expect(isOfOtherBodies(run.state.getState(), documents.state.getState())).toBe(false);
  mesher.dispose();
});

it("a run that is cancelled before its front closed says how far it came", async () => {
  const real = await createMesher();
  const isCancelled = { front: Uint32Array.from([0, 1, 2]), tetrahedra: 1234, status: "cancelled" } as const;
  const mesher: Mesher = Object.assign(Object.create(real) as Mesher, {
    meshProject: async (...[project, options, control]: Parameters<Mesher["meshProject"]>) => {
      const { report: whole, ...rest } = await real.meshProject(project, options);
      control?.onProgress?.({ ...report("volume", 0), expectedTetrahedra: 56_789 });
      const { front, tetrahedra, status } = isCancelled;
      return { ...rest, front, report: { ...whole, tetrahedra, status } };
    },
  });
  const documents = new DocumentStore({ ...emptyProject("a"), bodies: [bodyOf(1)] });
  const run = new MeshRun(documents, Promise.resolve(mesher));
  expect(cancelledText(run.state.getState())).toBeNull();
  await run.generate();
  expect(cancelledText(run.state.getState())).toBe("Cancelled at 1,234 of about 57,000 tetrahedra");
  expect(run.state.getState().log.at(-1)?.text).toMatch(/^Cancelled after .* of about 57,000 tetrahedra$/);
  real.dispose();
});

describe("a run that prepares the model", () => {
  const cancelled = (signal: AbortSignal): Promise<never> =>
    new Promise((_, reject) => signal.addEventListener("abort", () => reject(signal.reason as Error)));

  it("is busy from the start, says what it does, and meshes what was made of the model", async () => {
    const mesher = await createMesher();
    const documents = new DocumentStore(emptyProject("a"));
    const run = new MeshRun(documents, Promise.resolve(mesher));
    const running = run.generate("user", ({ onPart }) => {
      onPart("Adding a body");
      documents.edit({ label: "Add", replace: { bodies: [bodyOf(1)] } });
      return Promise.resolve([{ level: "information", text: "a body was added" } as const]);
    });
    expect(run.state.getState()).toMatchObject({ busy: true, preparing: "Adding a body" });
    await running;
    const { busy, preparing, mesh, log } = run.state.getState();
    expect([busy, preparing, mesh?.report.status]).toEqual([false, null, "done"]);
    expect(log[1]?.text).toBe("a body was added");
    mesher.dispose();
  });

  it("has one progress for the preparation and the mesher, which never goes back", async () => {
    const mesher = await createMesher();
    const run = new MeshRun(
      new DocumentStore({ ...emptyProject("a"), bodies: [bodyOf(1)] }),
      Promise.resolve(mesher),
    );
    const shown: number[] = [];
    run.state.subscribe(({ busy, progress, preparedShare }) => {
      if (busy) shown.push(progress?.fraction ?? preparedShare);
    });
    await run.generate("user", async ({ onPart }) => {
      onPart("Inspecting");
      // A preview that has begun before the run.
      for (const fraction of [0.5, 0.6, 0.9]) onPart("Preparing", fraction);
      return Promise.resolve([]);
    });
    expect(shown.slice(0, 8)).toContain(0);
    expect(Math.max(...shown.filter((fraction) => fraction < 0.17))).toBeCloseTo(0.4 * 0.4, 9);
    expect(shown).toEqual(shown.toSorted((a, b) => a - b));
    expect(run.state.getState().preparedShare).toBe(0);
    mesher.dispose();
  });

  it("is cancelled, or ended by the preparation, without a mesh", async () => {
    const mesher = new Promise<never>(() => undefined);
    const run = new MeshRun(new DocumentStore(emptyProject("a")), mesher);
    const running = run.generate("user", ({ signal }) => cancelled(signal));
    run.cancel();
    await running;
    expect(run.state.getState()).toMatchObject({ busy: false, preparing: null, failure: null, mesh: null });
    expect(run.state.getState().log.map(({ text }) => text)).toEqual([
      "Cancelled before anything was meshed",
    ]);
    await run.generate("user", () => Promise.resolve(null));
    expect(run.state.getState()).toMatchObject({ busy: false, failure: null, log: [] });
  });

  it("says why the preparation has failed", async () => {
    const mesher = new Promise<never>(() => undefined);
    const run = new MeshRun(new DocumentStore(emptyProject("a")), mesher);
    await run.generate("user", () => Promise.reject(new Error("no memory")));
    expect(run.state.getState()).toMatchObject({ busy: false, failure: "no memory" });
  });
});

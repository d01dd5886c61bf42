import { createMesher, type Mesher } from "tetrafront";
import { createBody, type Project, type ProjectPreview } from "tetrafront/project";
import { afterAll, beforeAll, expect, it, vi } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { BodyFeed } from "../../../web/session/bodies";
import { DocumentStore, newDocument } from "../../../web/session/document-store";
import { PreviewFeed } from "../../../web/session/preview";
import { MeshRun } from "../../../web/session/run";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";

let real: Mesher;
beforeAll(async () => {
  real = await createMesher();
});
afterAll(() => real.dispose());

/** A mesher whose calls of one method end when they are answered, in their order, whether they were aborted or not. */
function answering<Name extends "meshProject" | "prepareBody" | "previewProject" | "improveMesh">(
  name: Name,
) {
  const calls: (() => Promise<void>)[] = [];
  const held = (...given: Parameters<Mesher[Name]>): Promise<unknown> => {
    const [first, second, third, fourth] = given as unknown as [never, never, never, never];
    // Without the signal of the caller: an answer may have been on its way.
    const control = { ...((name === "prepareBody" ? fourth : third) as object), signal: undefined };
    return new Promise((resolve, reject) => {
      calls.push(async () => {
        const call = real[name].bind(real) as (...all: unknown[]) => Promise<unknown>;
        const all = name === "prepareBody" ? [first, second, third, control] : [first, second, control];
        await call(...all).then(resolve, reject);
        await new Promise((next) => setTimeout(next));
      });
    });
  };
  const others = ["meshProject", "inspectMesh", "inspectSurface", "prepareBody", "repairSurface"] as const;
  const rest = Object.fromEntries(
    others.map((method) => [method, (real[method] as (...all: unknown[]) => unknown).bind(real)]),
  );
  const mesher = Object.assign(Object.create(real) as Mesher, rest, { [name]: held });
  const answer = async (index: number): Promise<void> => {
    await vi.waitUntil(() => calls[index] !== undefined);
    await calls[index]?.();
  };
  return { mesher: Promise.resolve(mesher), answer };
}

const withBody = (size: number): Project => ({
  ...emptyProject(`box ${size}`),
  bodies: [createBody(boxSurface(2, [0, 0, 0], [size, size, size]), { id: 1, firstPatchId: 1 })],
});

const otherCube = (): Project => ({ ...cubeProject(), meshing: { size: 0.4 } });

it("a run changes nothing once another document is shown, which is meshed after it", async () => {
  const { mesher, answer } = answering("meshProject");
  const documents = new DocumentStore(cubeProject());
  const run = new MeshRun(documents, mesher);
  const first = run.generate();
  documents.show(newDocument(otherCube()));
  expect(run.state.getState()).toMatchObject({ busy: false, log: [] });
  const states: unknown[] = [];
  const stop = run.state.subscribe((state) => void states.push(state));
  await answer(0);
  await first;
  stop();
  expect(states).toEqual([]);
  expect(run.state.getState()).toMatchObject({ mesh: null, outcome: null, failure: null });
  const second = run.generate();
  await answer(1);
  await second;
  const { mesh } = run.state.getState();
  expect(mesh?.report.fingerprint).toBe((await real.meshProject(otherCube())).report.fingerprint);
});

it("a run that begins before the former one has ended waits for it", async () => {
  const { mesher, answer } = answering("meshProject");
  const documents = new DocumentStore(cubeProject());
  const run = new MeshRun(documents, mesher);
  const first = run.generate();
  documents.show(newDocument(otherCube()));
  const second = run.generate();
  expect(run.state.getState().busy).toBe(true);
  await answer(0);
  await first;
  expect(run.state.getState()).toMatchObject({ busy: true, mesh: null });
  await answer(1);
  await second;
  const { busy, mesh } = run.state.getState();
  expect([busy, mesh?.report.fingerprint]).toEqual([
    false,
    (await real.meshProject(otherCube())).report.fingerprint,
  ]);
});

it("a mesh is shown again with its document, and only with it", async () => {
  const documents = new DocumentStore(cubeProject());
  const run = new MeshRun(documents, Promise.resolve(real));
  await run.generate();
  const { mesh } = run.state.getState();
  const before = documents.show(newDocument(otherCube()));
  expect(run.state.getState()).toMatchObject({ mesh: null, outcome: null, log: [] });
  documents.show(before);
  expect(run.state.getState().mesh).toBe(mesh);
});

it("an improvement ends without a word once another document is shown", async () => {
  const { mesher, answer } = answering("improveMesh");
  const documents = new DocumentStore(cubeProject());
  const run = new MeshRun(documents, mesher);
  await run.generate();
  const improving = run.improve();
  documents.show(newDocument(otherCube()));
  await answer(0);
  expect(await improving).toBeNull();
  expect(run.state.getState()).toMatchObject({ busy: false, mesh: null, log: [] });
});

it("a body has no triangles and no progress of the body with the same id in the document before", async () => {
  const { mesher, answer } = answering("prepareBody");
  const documents = new DocumentStore(withBody(1));
  const bodies = new BodyFeed(documents, mesher);
  const preparing = bodies.prepare(1);
  expect(bodies.state.getState().byId.get(1)?.preparing).toBe(0);
  documents.show(newDocument(withBody(2)));
  expect(bodies.state.getState().byId.get(1)).toMatchObject({ preparing: null, preparation: null });
  await answer(0);
  await preparing;
  const failure = { preparationFailure: null, failedKey: null };
  expect(bodies.state.getState().byId.get(1)).toMatchObject({
    preparing: null,
    preparation: null,
    ...failure,
  });
});

it("samples of the document before are not shown, though they come late", async () => {
  const { mesher, answer } = answering("previewProject");
  const [before, after] = [cubeProject(), otherCube()];
  const documents = new DocumentStore(before);
  const previews = new PreviewFeed(documents, mesher);
  const sampled: (Project | null)[] = [];
  previews.state.subscribe(({ project }) => void sampled.push(project));
  documents.show(newDocument(after));
  await answer(0);
  await answer(1);
  const last: ProjectPreview | null = previews.state.getState().preview;
  expect(last?.linePoints.length).toBeGreaterThan(0);
  expect(sampled.filter((project) => project !== null)).toEqual([after]);
});

it("a document that is shown again is sampled again, though its project is the same object", async () => {
  const project = withBody(1);
  const documents = new DocumentStore(project);
  const bodies = new BodyFeed(documents, Promise.resolve(real));
  documents.show(newDocument(project));
  expect(bodies.state.getState().byId.size).toBe(1);
  await bodies.settled(new AbortController().signal);
});

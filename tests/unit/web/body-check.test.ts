import { createMesher, type Mesher, type PreparedBody, type RunControl } from "tetrafront";
import { createBody, type Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";
import type { BodyFeed } from "../../../web/session/bodies";
import { BodyCheck } from "../../../web/session/body-check";
import { BodyPreparations } from "../../../web/session/body-preparations";
import { DocumentStore } from "../../../web/session/document-store";
import type { PreviewFeed } from "../../../web/session/preview";
import { ProblemList } from "../../../web/session/problems";
import type { MeshRun } from "../../../web/session/run";
import { BodyPairs } from "../../../web/session/touching-bodies";
import type { SurfaceClient } from "../../../web/workers/surface-files";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";

const withBodies = (count: number): Project => ({
  ...cubeProject(),
  bodies: Array.from({ length: count }, (_, k) =>
    createBody(boxSurface(1), { id: k + 1, firstPatchId: 20 + k, name: `box ${k + 1}` }),
  ),
});

const prepared: PreparedBody = {
  ...boxSurface(1),
  trianglePatch: new Uint32Array(12),
} as unknown as PreparedBody;

it("a check that an edit has ended says nothing of the project, even if undo restores it", async () => {
  const ends: (() => void)[] = [];
  const mesher = {
    checkProject: (_project: unknown, _options: unknown, { signal }: RunControl) =>
      new Promise((resolve, reject) => {
        const number = ends.length;
        ends.push(() => {
          const found = { severity: "error", code: "self-intersection", entities: [], number };
          if (signal?.aborted) reject(new Error("cancelled"));
          else resolve({ isFillable: false, expectedTetrahedra: null, diagnostics: [found] });
        });
      }),
  } as unknown as Mesher;
  const documents = new DocumentStore(withBodies(1));
  const bodies = {
    state: { subscribe: () => () => undefined, getState: () => ({ byId: new Map() }) },
    pairs: new BodyPairs(),
    preparations: { allOf: () => [prepared] },
  } as unknown as BodyFeed;
  const check = new BodyCheck(documents, Promise.resolve(mesher), bodies);
  const resize = (size: number): void => documents.edit({ label: "Size", replace: { meshing: { size } } });
  const checks = (count: number) => vi.waitFor(() => expect(ends).toHaveLength(count));
  resize(0.3);
  await checks(1);
  resize(0.4);
  await checks(2);
  documents.undo();
  await checks(3);
  ends[0]?.();
  ends[1]?.();
  await new Promise((resolve) => setTimeout(resolve));
  expect(check.state.getState()).toEqual({ key: null, errors: [], touching: [] });
  ends[2]?.();
  await vi.waitFor(() => expect(check.state.getState().errors).toMatchObject([{ number: 2 }]));
});

it("the triangles of all bodies are kept, however many there are, and however often one of them changes", async () => {
  const mesher = { prepareBody: () => Promise.resolve(prepared) } as unknown as Mesher;
  const surfaces = { draw: () => Promise.resolve({}) } as unknown as SurfaceClient;
  let project = withBodies(6);
  const preparations = new BodyPreparations(Promise.resolve(mesher), surfaces, () => project);
  const make = async (project: Project, index: number): Promise<void> => {
    const body = project.bodies?.[index];
    if (body) await preparations.make(project, body, new AbortController().signal, () => undefined);
  };
  for (let k = 0; k < 6; ++k) await make(project, k);
  const [first, ...others] = project.bodies ?? [];
  const given = project;
  for (let k = 1; first && k < 8; ++k) {
    project = { ...project, bodies: [{ ...first, remeshing: { size: k / 10 } }, ...others] };
    await make(project, 0);
  }
  expect(preparations.allOf(project)).toHaveLength(6);
  expect(preparations.allOf(given)).toHaveLength(5);
});

describe("bodies that touch", () => {
  let mesher: Mesher;
  beforeAll(async () => void (mesher = await createMesher()));
  afterAll(() => mesher.dispose());

  /** Two bodies that touch, and a third one that intersects the drawn cube. */
  const project = (): Project => {
    const at = (x: number) => ({ position: [x, 0.25, 0.25] as const, scale: 0.5 });
    return {
      ...withBodies(3),
      meshing: { size: 0.5 },
      bodies: (withBodies(3).bodies ?? []).map((body, k) => ({
        ...body,
        surface: "keep" as const,
        placement: at([5, 5.5, 0.75][k] ?? 0),
      })),
    };
  };

  const opened = async (): Promise<{ documents: DocumentStore; check: BodyCheck; problems: ProblemList }> => {
    const preparedBodies = await Promise.all([1, 2, 3].map((id) => mesher.prepareBody(project(), id)));
    const documents = new DocumentStore(project(), () => 0);
    const bodies = {
      state: {
        subscribe: () => () => undefined,
        getState: () => ({
          byId: new Map(
            (documents.project.bodies ?? []).map((body) => {
              const surface = { ...boxSurface(1), trianglePatch: new Uint32Array(12) };
              const inspection = { isFillable: true, volume: 1, diagnostics: [] };
              return [body.id, { body, loaded: { surface }, inspection, preparationErrors: [] }];
            }),
          ),
        }),
      },
      pairs: new BodyPairs(),
      preparations: { allOf: () => preparedBodies },
    } as unknown as BodyFeed;
    const check = new BodyCheck(documents, Promise.resolve(mesher), bodies);
    const none = {
      state: { getState: () => ({ preview: null, checked: null }), subscribe: () => () => undefined },
    };
    const run = { state: { getState: () => ({ outcome: null }), subscribe: () => () => undefined } };
    const problems = new ProblemList({
      documents,
      previews: none as unknown as PreviewFeed,
      bodies,
      check,
      run: run as unknown as MeshRun,
    });
    return { documents, check, problems };
  };

  it("do not hide other errors, and messages have the present names", async () => {
    const { documents, check, problems } = await opened();
    const messages = (code: string): readonly string[] =>
      problems.state.getState().problems.flatMap((problem) => (problem.code === code ? problem.message : []));
    documents.edit({ label: "Size", replace: { meshing: { size: 0.4 } } });
    await vi.waitFor(() => expect(check.state.getState().key).not.toBeNull(), { timeout: 20_000 });
    expect(check.state.getState().touching).toEqual([[1, 2]]);
    expect(messages("touching-bodies")).toEqual([expect.stringMatching(/box 1.*box 2/)]);
    const found = messages("self-intersection");
    expect(found.length).toBeGreaterThan(0);
    for (const message of found) expect(message).not.toMatch(/box [12]/);
    expect(found.join()).toContain("box 3");
    const rename = (index: number, name: string): void =>
      documents.edit({
        label: "Rename",
        change: ({ project: draft }) => {
          const body = draft.bodies?.[index];
          if (body) body.name = name;
        },
      });
    rename(0, "left");
    expect(messages("touching-bodies")).toEqual([expect.stringMatching(/left.*box 2/)]);
    rename(2, "right");
    await vi.waitFor(() => expect(messages("self-intersection").join()).toContain("right"), {
      timeout: 20_000,
    });
  });
});

import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { createMesher, type Mesher } from "tetrafront";
import { adaptToField, runCycles, type Solver } from "../../../web/session/adaptation";
import { DocumentStore, newDocument } from "../../../web/session/document-store";
import {
  defaultCondition,
  defaultSetup,
  problemOf,
  type ProblemSetup,
} from "../../../web/session/problem-setup";
import { MeshRun } from "../../../web/session/run";
import { Solutions } from "../../../web/session/solutions";
import { SolveError } from "../../../web/solve/problem";
import { solveProblem } from "../../../web/solve/solve-problem";
import { cubeProject } from "../../support/projects";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** A solver in this thread. `solved` counts its calls. */
function solverHere(): Solver & { solved: number } {
  const solver = {
    solved: 0,
    solve: ({ mesh, problem, start }, signal) => {
      signal.throwIfAborted();
      solver.solved += 1;
      return Promise.resolve(solveProblem(mesh, problem, start));
    },
    dispose: () => undefined,
  } satisfies Solver & { solved: number };
  return solver;
}

/** A meshed cube, with the names of its patches. */
async function meshedCube(usedMesher = mesher) {
  const documents = new DocumentStore(cubeProject());
  const run = new MeshRun(documents, Promise.resolve(usedMesher));
  const solutions = new Solutions(documents, run);
  await run.generate();
  const patches = (run.state.getState().mesh?.mesh.patches ?? []).map(({ name }) => name);
  return { documents, run, solutions, patches };
}

/** Returns the mesher with a call after each computation of sizes. */
const afterSizes = (call: () => void): Mesher =>
  new Proxy(mesher, {
    get: (target, name) => {
      if (name === "sizeFromSolution")
        return async (...given: Parameters<Mesher["sizeFromSolution"]>) => {
          const sizes = await target.sizeFromSolution(...given);
          call();
          return sizes;
        };
      const part: unknown = Reflect.get(target, name);
      return typeof part === "function" ? (part.bind(target) as unknown) : part;
    },
  });

/** Heat that enters the cube everywhere and leaves it by one patch. */
const heated = (patches: readonly string[]): ProblemSetup => ({
  ...defaultSetup,
  source: 10,
  conditions: patches.slice(0, 1).map((patch) => defaultCondition("heat", patch)),
});

const settings = { cycles: 2, elements: 3000, norm: "l2" } as const;

describe("cycles", () => {
  it("list meshes whose errors fall, and show the last one as one step of undo", async () => {
    const { documents, run, solutions, patches } = await meshedCube();
    const first = run.state.getState().mesh;
    await runCycles({ run, solutions }, heated(patches), settings, solverHere);
    const { meshes, at, shown, choice } = solutions.state.getState();
    expect(meshes).toHaveLength(3);
    expect(at).toBe(2);
    expect(meshes[0]?.mesh).toBe(first);
    const errors = meshes.map(({ estimatedError }) => estimatedError ?? 0);
    expect(errors[1]).toBeLessThan(errors[0] ?? 0);
    expect(errors[2]).toBeLessThan(errors[1] ?? 0);
    const count = meshes[2]?.mesh.report.tetrahedra ?? 0;
    expect(count / settings.elements).toBeGreaterThan(0.6);
    expect(count / settings.elements).toBeLessThan(1.5);
    expect(meshes[2]?.mesh.mesh.patches.map(({ name }) => name).toSorted()).toEqual(patches.toSorted());
    expect(choice).toMatchObject({ name: "temperature" });
    expect(shown?.values).toHaveLength((meshes[2]?.mesh.mesh.points.length ?? 0) / 3);
    expect(shown?.range[0]).toBeCloseTo(0, 6);

    documents.undo();
    expect(run.state.getState().mesh).toBe(first);
    expect(solutions.state.getState()).toMatchObject({ at: 0 });
    documents.redo();
    expect(run.state.getState().mesh).toBe(meshes[2]?.mesh);
    solutions.show(1);
    expect(run.state.getState().mesh).toBe(meshes[1]?.mesh);
    expect(solutions.state.getState()).toMatchObject({ at: 1 });
  });

  it("that are stopped keep what is solved", async () => {
    const { run, solutions, patches } = await meshedCube();
    solutions.state.subscribe(({ meshes }) => meshes.length === 1 && run.cancel());
    await runCycles({ run, solutions }, heated(patches), settings, solverHere);
    expect(solutions.state.getState().meshes).toHaveLength(1);
    expect(run.state.getState()).toMatchObject({ busy: false, preparing: null });
  });

  it("that fail later keep what is solved before, as one step of undo", async () => {
    const { documents, run, solutions, patches } = await meshedCube();
    const first = run.state.getState().mesh;
    const solver = solverHere();
    const failing: Solver = {
      ...solver,
      solve: (request, signal) =>
        solver.solved === 2 ? Promise.reject(new SolveError("not-converged")) : solver.solve(request, signal),
    };
    const failed = runCycles({ run, solutions }, heated(patches), settings, () => failing);
    await expect(failed).rejects.toMatchObject({ failure: "not-converged" });
    const { meshes, at } = solutions.state.getState();
    expect([meshes.length, at]).toEqual([2, 1]);
    expect(run.state.getState()).toMatchObject({ busy: false, mesh: meshes[1]?.mesh });
    documents.undo();
    expect(run.state.getState().mesh).toBe(first);
  });

  it("end with why a problem has no solution, and leave the mesh", async () => {
    const { run, solutions } = await meshedCube();
    const before = run.state.getState().mesh;
    const failed = runCycles({ run, solutions }, defaultSetup, settings, solverHere);
    await expect(failed).rejects.toThrow(SolveError);
    expect(run.state.getState()).toMatchObject({ busy: false, mesh: before });
    expect(solutions.state.getState().meshes).toEqual([]);
  });

  it("go on without showing their meshes in another step of undo", async () => {
    const { documents, run, solutions } = await meshedCube();
    const first = run.state.getState().mesh;
    documents.edit({ label: "", change: (draft) => void (draft.project.meshing = { size: 0.4 }) });
    await run.generate();
    const second = run.state.getState().mesh;
    const patches = (second?.mesh.patches ?? []).map(({ name }) => name);
    solutions.state.subscribe(({ meshes }) => {
      if (meshes.length === 2 && run.state.getState().mesh === meshes[1]?.mesh) documents.undo();
    });
    await runCycles({ run, solutions }, heated(patches), settings, solverHere);
    expect(run.state.getState().mesh).toBe(first);
    expect(solutions.state.getState()).toMatchObject({ meshes: [], at: null });
    documents.redo();
    expect(run.state.getState().mesh).toBe(second);
  });

  it("show with each mesh what is known of it", async () => {
    const { run, solutions, patches } = await meshedCube();
    await runCycles({ run, solutions }, heated(patches), { ...settings, cycles: 1 }, solverHere);
    expect(run.state.getState()).toMatchObject({ edgeReference: "mean", isValid: true });
    solutions.show(0);
    expect(run.state.getState()).toMatchObject({ edgeReference: "target", isValid: null });
  });

  it("on the same mesh show the values of the last problem", async () => {
    const { run, solutions, patches } = await meshedCube();
    const once = { ...settings, cycles: 0 };
    await runCycles({ run, solutions }, heated(patches), once, solverHere);
    const { shown: before } = solutions.state.getState();
    await runCycles({ run, solutions }, { ...heated(patches), source: 40 }, once, solverHere);
    const { shown: after } = solutions.state.getState();
    expect(after?.tetrahedra).toBe(before?.tetrahedra);
    expect((after?.range[1] ?? 0) / (before?.range[1] ?? 0)).toBeCloseTo(4, 5);
  });

  it("that are answered after their document has been left list nothing", async () => {
    // The document is left when the sizes for the error are known, and their norm is not.
    const leave = (): void => void documents.show(newDocument(cubeProject()));
    const { documents, run, solutions, patches } = await meshedCube(afterSizes(leave));
    const left = runCycles({ run, solutions }, heated(patches), { ...settings, cycles: 0 }, solverHere);
    await expect(left).rejects.toThrow();
    expect(solutions.state.getState()).toMatchObject({ meshes: [], at: null, choice: null });
  });

  it("are forgotten when another mesh is generated", async () => {
    const { documents, run, solutions, patches } = await meshedCube();
    await runCycles({ run, solutions }, heated(patches), { ...settings, cycles: 0 }, solverHere);
    expect(solutions.state.getState().meshes).toHaveLength(1);
    documents.edit({ label: "", change: (draft) => void (draft.project.meshing = { size: 0.4 }) });
    await run.generate();
    expect(solutions.state.getState()).toMatchObject({ meshes: [], at: null, shown: null });
  });
});

it("a mesh is adapted to a field, which is transferred", async () => {
  const { run, solutions, patches } = await meshedCube();
  await runCycles({ run, solutions }, heated(patches), { ...settings, cycles: 0 }, solverHere);
  const [field] = solutions.state.getState().meshes[0]?.fields ?? [];
  if (!field) throw new Error("There is no field");
  await adaptToField({ run, solutions }, field, { elements: 2500, norm: "l2" });
  const { meshes, at, shown } = solutions.state.getState();
  expect(at).toBe(1);
  expect(meshes[1]?.mesh.report.tetrahedra).toBeGreaterThan(1500);
  expect(meshes[1]?.fields.map(({ name }) => name)).toEqual(["temperature", "heat flux"]);
  expect(shown?.tetrahedra).toBe(meshes[1]?.mesh.mesh.tetrahedra);
  const [before, after] = meshes.map(({ fields }) => Math.max(...(fields[0]?.values ?? [])));
  expect(after).toBeCloseTo(before ?? 0, 1);
  // A download has them too.
  const { mesh } = run.state.getState();
  if (!mesh) throw new Error("There is no mesh");
  const { nodeData } = solutions.withFields(mesh.mesh);
  expect([...nodeData.keys()]).toEqual(["temperature", "heat flux"]);
  expect(nodeData.get("temperature")?.values).toHaveLength(mesh.mesh.points.length / 3);
  const other = { ...mesh.mesh, tetrahedra: mesh.mesh.tetrahedra.slice(), nodeData: new Map() };
  expect(solutions.withFields(other).nodeData.size).toBe(0);
});

it("conditions belong to patches by name, and to the kind of the problem", () => {
  const conditions = [
    { ...defaultCondition("heat", "a"), value: 3 },
    defaultCondition("elasticity", "b"),
    defaultCondition("heat", "missing"),
  ];
  const heat = problemOf({ ...defaultSetup, conditions }, ["b", "a", "a"]);
  expect([...heat.conditions]).toEqual([
    [1, { kind: "value", value: 3 }],
    [2, { kind: "value", value: 3 }],
  ]);
  const elastic = problemOf({ ...defaultSetup, kind: "elasticity", conditions }, ["b", "a"]);
  expect([...elastic.conditions]).toEqual([[0, { kind: "fixed" }]]);
});

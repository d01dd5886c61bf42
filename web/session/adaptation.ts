/** Solves a problem on the shown mesh and adapts the mesh to the solution, cycle by cycle: what the package offers, with a solver of the app. */
import type { CycleOptions, MeshAdaptation, Mesher, MeshResult } from "tetrafront";
import {
  correctedNumber,
  dataOf,
  estimatedErrors,
  inspectedResult,
  meshWithBoundary,
} from "tetrafront/internal";
import { SolveClient } from "../solve/solve-client";
import { solutionStrings as texts } from "../strings/solution";
import { problemOf, type ProblemSetup } from "./problem-setup";
import type { MeshRun, WorkControl } from "./run";
import { shownParts, type ShownMesh } from "./shown-mesh";
import { chosenField, type FieldChoice, type MeshField, type SolvedMesh, type Solutions } from "./solutions";

export type Norm = NonNullable<CycleOptions["norm"]>;

export interface CycleSettings {
  readonly cycles: number;
  /** Number of elements of the last mesh. */
  readonly elements: number;
  readonly norm: Norm;
}

/** How an adaptation aims: at a number of elements, or at an error of the field. */
export type Target = Pick<CycleOptions, "elements" | "error"> & { readonly norm: Norm };

export interface AdaptedSession {
  readonly run: MeshRun;
  readonly solutions: Solutions;
}

/** The part of the solver's client that cycles use. */
export type Solver = Pick<SolveClient, "solve" | "dispose">;

/** Shares of a cycle that its parts take, about. */
const shares = { solve: 0.25, sizes: 0.35, adapt: 0.95 } as const;

/**
 * Solves the problem on the shown mesh, then adapts the mesh and solves again, as often as there are cycles; 0 only solves. The
 * numbers of elements grow by equal ratios. Lists and shows every mesh as soon as it is solved. If the user stops the cycles, those
 * that are done stay. Rejects with a `SolveError` if the problem has no unique solution. If a later cycle fails, those before it stay too.
 */
export async function runCycles(
  session: AdaptedSession,
  setup: ProblemSetup,
  settings: CycleSettings,
  startSolver: () => Solver = () => new SolveClient(),
): Promise<void> {
  const failures: unknown[] = [];
  await session.run.adapt(async (control) => {
    const cycles = new Cycles(session, { setup, settings, control, solver: startSolver() });
    try {
      await cycles.run();
    } catch (error) {
      if (cycles.last === null) throw error;
      if (!control.signal.aborted) failures.push(error);
    } finally {
      cycles.dispose();
    }
    return cycles.last;
  });
  if (failures.length > 0) throw failures[0];
}

interface CycleParts {
  readonly setup: ProblemSetup;
  readonly settings: CycleSettings;
  readonly control: WorkControl;
  readonly solver: Solver;
}

class Cycles {
  readonly #session: AdaptedSession;
  readonly #setup: ProblemSetup;
  readonly #settings: CycleSettings;
  readonly #control: WorkControl;
  readonly #solver: Solver;
  readonly #began = performance.now();
  #solved: readonly SolvedMesh[] = [];
  /** Number of elements that the last sizes have asked for. */
  #asked: number | undefined;
  /** The last mesh that is solved, in the form in which it is shown. */
  #last: ShownMesh | null = null;

  constructor(session: AdaptedSession, { setup, settings, control, solver }: CycleParts) {
    this.#session = session;
    this.#setup = setup;
    this.#settings = settings;
    this.#control = control;
    this.#solver = solver;
  }

  /** The last mesh that is solved; null before the first one. */
  get last(): ShownMesh | null {
    return this.#last;
  }

  async run(): Promise<void> {
    const state = this.#session.run.state.getState();
    const first = state.mesh;
    if (!first) return;
    const { cycles } = this.#settings;
    let made: AdaptedMesh = {
      ...shownParts({ ...state, mesh: first }),
      start: null,
      leastQuality: null,
    };
    for (let cycle = 0; cycle <= cycles; ++cycle) {
      const field = await this.#solve(cycle, made);
      if (cycle < cycles) made = await this.#adapt(cycle, first, made.mesh, field);
    }
  }

  /** Solves on a mesh, and shows the solution. Returns the field that decides the sizes. */
  async #solve(cycle: number, made: AdaptedMesh): Promise<MeshField> {
    const { start, leastQuality } = made;
    const { mesh } = made.mesh;
    const { signal, mesher } = this.#control;
    this.#report(cycle, cycle, texts.solving);
    const names = mesh.patches.map(({ name }) => name);
    const problem = problemOf(this.#setup, names);
    const { fields } = await this.#solver.solve({ mesh, problem, start }, signal);
    const [unknown] = fields;
    if (unknown === undefined) throw new Error("A solution has no field");
    const { norm } = this.#settings;
    const [estimatedError = null] = await estimatedErrors(mesher, mesh, { fields: [unknown], norm }, () => ({
      signal,
    }));
    signal.throwIfAborted();
    this.#last = shownParts(made);
    this.#show({ ...this.#last, fields, estimatedError, leastQuality });
    return unknown;
  }

  /** Makes the next mesh, and the start of its solution. */
  async #adapt(
    cycle: number,
    { mesh: first }: MeshResult,
    { mesh }: MeshResult,
    field: MeshField,
  ): Promise<AdaptedMesh> {
    const { mesher, signal } = this.#control;
    const { norm } = this.#settings;
    const wanted = this.#elementsOf(cycle + 1, first.tetrahedra.length / 4);
    const elements = correctedNumber(wanted, mesh, this.#asked);
    const sizes = await mesher.sizeFromSolution(
      mesh,
      [field],
      { elements, norm },
      this.#part(cycle, shares.solve, shares.sizes, texts.sizing),
    );
    this.#asked = sizes.elements;
    const next = await mesher.adaptMesh(
      first,
      sizes.mesh,
      {},
      this.#part(cycle, shares.sizes, shares.adapt, texts.adapting),
    );
    const made = await resultOf(mesher, next, this.#began);
    const { fields } = await mesher.transferSolution(mesh, made.mesh.mesh, [field], {}, { signal });
    return { ...made, start: fields[0]?.values ?? null };
  }

  /** Returns the number of elements of a cycle, between those of the first mesh and of the last one. */
  #elementsOf(cycle: number, first: number): number {
    const { cycles, elements } = this.#settings;
    return Math.round(first * (elements / first) ** (cycle / cycles));
  }

  #show(solved: SolvedMesh): void {
    const { solutions } = this.#session;
    this.#solved = [...this.#solved, solved];
    solutions.list(this.#solved);
    const [first] = solved.fields;
    const { choice } = solutions.state.getState();
    if (!chosenField(solved.fields, choice) && first) solutions.choose(firstChoice(first));
    this.#control.show(solved);
  }

  /** Returns the control of a part of what follows the solution of a cycle, which makes the mesh of the next one. */
  #part(cycle: number, from: number, to: number, text: string) {
    const { signal } = this.#control;
    this.#report(cycle + 1, cycle + from, text);
    return {
      signal,
      onProgress: ({ fraction }: { readonly fraction: number }) =>
        this.#report(cycle + 1, cycle + from + (to - from) * fraction, text),
    };
  }

  /** `done`: number of cycles that are done, with the share of the present one. A cycle begins when the mesh of the one before is solved. */
  #report(cycle: number, done: number, text: string): void {
    const { cycles } = this.#settings;
    this.#control.onPart(cycles === 0 ? text : texts.ofCycle(text, cycle, cycles), done / (cycles + 1));
  }

  dispose(): void {
    this.#solver.dispose();
  }
}

interface AdaptedResult extends ShownMesh, Pick<SolvedMesh, "leastQuality"> {}

/** A mesh, and what its solution begins with. */
interface AdaptedMesh extends AdaptedResult {
  /** Values of the unknown at its nodes, from the mesh before; null for the first mesh. */
  readonly start: Float64Array | null;
}

/** Returns the values of a field that are shown first. */
export const firstChoice = ({
  name,
  components,
  isPerElement = false,
}: Omit<MeshField, "values">): FieldChoice => ({
  name,
  component: components === 1 ? 0 : ("magnitude" as const),
  label: name,
  isPerElement,
});

/** Returns an adapted mesh in the form in which a run returns its mesh, without the metric that it was made with. */
async function resultOf(
  mesher: Mesher,
  { mesh: adapted, after }: MeshAdaptation,
  began: number,
): Promise<AdaptedResult> {
  const opened = await meshWithBoundary({ ...adapted, nodeData: new Map() });
  const inspection = await mesher.inspectMesh(opened.mesh);
  const { report, ...result } = inspectedResult(opened, inspection);
  // Elements are thin where the metric asks for that: their shapes in space are no problem.
  const diagnostics = report.diagnostics.filter(({ code }) => code !== "poor-elements");
  const seconds = { ...report.seconds, total: (performance.now() - began) / 1000 };
  return {
    mesh: { ...result, report: { ...report, diagnostics, seconds } },
    edgeReference: "mean",
    origin: null,
    improvement: null,
    leastQuality: after.leastQuality,
    isValid: inspection.isValid,
  };
}

/** How many elements an adaptation would make, and the error to expect on them. */
export interface AdaptationForecast {
  readonly elements: number;
  readonly error: number;
}

/** Returns what an adaptation of the mesh to a field would make. */
export async function forecast(
  mesher: Mesher,
  { mesh }: SolvedMesh,
  field: MeshField,
  target: Target,
  signal: AbortSignal,
): Promise<AdaptationForecast> {
  const sizes = await mesher.sizeFromSolution(mesh.mesh, [field], target, { signal });
  return { elements: sizes.elements, error: sizes.expectedErrors[0] ?? 0 };
}

/** Adapts the shown mesh to one of its fields, and transfers all fields to the new mesh, which is listed after it. */
export async function adaptToField(
  { run, solutions }: AdaptedSession,
  field: MeshField,
  target: Target,
): Promise<void> {
  const { meshes, at } = solutions.state.getState();
  const solved = at === null ? undefined : meshes[at];
  if (!solved) return;
  let listed: readonly SolvedMesh[] = meshes;
  const isShown = await run.adapt(async ({ mesher, signal, onPart }) => {
    const began = performance.now();
    const { mesh } = solved.mesh;
    const part = (from: number, to: number, text: string) => ({
      signal,
      onProgress: ({ fraction }: { readonly fraction: number }) =>
        onPart(text, from + (to - from) * fraction),
    });
    const sizes = await mesher.sizeFromSolution(mesh, [field], target, part(0, 0.1, texts.sizing));
    const next = await mesher.adaptMesh(mesh, sizes.mesh, {}, part(0.1, 0.9, texts.adapting));
    const made = await resultOf(mesher, next, began);
    const { fields } = await mesher.transferSolution(
      mesh,
      made.mesh.mesh,
      solved.fields,
      {},
      part(0.9, 1, texts.transferring),
    );
    const moved = fields.map(({ name = "", ...field }) => ({ ...field, name }));
    signal.throwIfAborted();
    // The mesh keeps its fields when the list is forgotten, for example by undo and redo.
    const withFields = { ...made.mesh, mesh: { ...made.mesh.mesh, ...dataOf(moved) } };
    const adapted = { ...made, mesh: withFields, fields: moved, estimatedError: null };
    listed = [...meshes.slice(0, (at ?? 0) + 1), adapted];
    solutions.list(listed);
    return shownParts(adapted);
  });
  // The model has changed meanwhile.
  if (!isShown && solutions.state.getState().meshes === listed) solutions.list(meshes);
}

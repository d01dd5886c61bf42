/** `tetrafront adapt --solver`: adapts the mesh of a model to the solution of a solver, cycle by cycle. */
import path from "node:path";
import {
  adaptationCycles,
  checkCycleOptions,
  decidingNames,
  DEFAULT_CYCLES,
} from "../api/adaptation-cycles.js";
import type { Mesher } from "../api/mesher-interface.js";
import type { CycleOptions } from "../api/option-types.js";
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { RunControl } from "../engine/control.js";
import { extensionOf, extensionsFor, formatOf } from "../formats/file-formats.js";
import type { AdaptationCycle, Solution, SolveContext } from "../mesh/adaptation-cycle.js";
import type { PatchLayers } from "../mesh/layered-mesh.js";
import type { Mesh } from "../mesh/mesh.js";
import { CycleFolder, type CycleList, type CycleReport, hashOf } from "./cycle-folder.js";
import { writeMeshTo } from "./convert.js";
import { checkInput, FileError } from "./files.js";
import { extensionOfFormat, isCadInput, numberIn, readMeshFile, refuseOptions } from "./input.js";
import { layersIn, layersOf } from "./layers.js";
import { asInvalidInput, print, printDiagnostics } from "./messages.js";
import { withRun } from "./run.js";
import { runSolver, type SolverFiles } from "./solver.js";
import {
  fieldsFor,
  readElements,
  readSolFile,
  sizeOptions,
  type SolutionSizeCommandOptions,
} from "./solution.js";
import { enterStage } from "./stages.js";

/** Options as commander passes them. */
export interface CycleCommandOptions extends SolutionSizeCommandOptions {
  readonly output: string;
  readonly from?: string;
  readonly solver?: string;
  readonly cycles?: string;
  readonly field?: readonly string[];
  readonly layers?: readonly string[];
  readonly conservative?: boolean;
  readonly meshFormat?: string;
  readonly solutionFormat?: string;
  readonly folder?: string;
  readonly resume?: boolean;
  readonly quality?: string;
  readonly sweeps?: string;
}

/** Result of all cycles. */
export interface CycledMesh {
  /** The last mesh, with the fields of the last solution. */
  readonly mesh: Mesh;
  readonly cycles: readonly CycleReport[];
  readonly folder: string;
}

/** Format of the meshes that are kept: it stores coordinates, names and fields without loss. */
const KEPT = ".vtu";

/** Returns the options of the cycles. Throws an InvalidInput. */
export function cycleOptions(options: CycleCommandOptions): CycleOptions {
  const chosen: CycleOptions = {
    ...sizeOptions(options),
    cycles: numberIn(options.cycles) ?? DEFAULT_CYCLES,
    fields: options.field,
    layers: options.layers && layersIn(options.layers),
    conservative: options.conservative,
    leastQuality: numberIn(options.quality),
    sweeps: numberIn(options.sweeps),
  };
  refuseOptions(checkCycleOptions(chosen));
  return chosen;
}

/** Options that only the cycles have. */
const ONLY_CYCLES = [
  "solver", "cycles", "field", "elements", "error", "norm", "isotropic", "minSize", "maxSize", "maxAspect", "gradation",
  "indicator", "indicatorOrder", "conservative", "meshFormat", "solutionFormat", "folder", "resume",
] as const; // prettier-ignore

/** Those that layers have, too. */
export const WITH_LAYERS = ["cycles", "maxAspect", "gradation"] as const;

/** Throws an InvalidInput if an option of the cycles is given without a solver. `others`: those that have another meaning then. */
export function refuseCycleOptions(
  options: Partial<CycleCommandOptions>,
  others: readonly (typeof ONLY_CYCLES)[number][] = [],
): void {
  const given = ONLY_CYCLES.find((name) => options[name] !== undefined && !others.includes(name));
  if (given === undefined) return;
  const word = `--${given.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}`;
  const alsoLayers = WITH_LAYERS.some((name) => name === given);
  const remedy = `Add --solver with the command of a solver${alsoLayers ? ", or --layers," : ""} or omit it.`;
  const users = alsoLayers ? "cycles with a solver and for layers" : "cycles with a solver";
  refuseOptions([invalidOption(word, `${word} is for ${users}`, remedy)]);
}

/** What is adapted, and how. */
interface Task {
  readonly input: string;
  readonly options: CycleCommandOptions & { readonly solver: string };
  /** The checked options of the cycles. */
  readonly chosen: CycleOptions;
  readonly isQuiet: boolean;
}

/**
 * Runs the cycles. `firstMesh` reads or makes the mesh of the model. All files are kept in a folder, from which `--resume`
 * continues.
 */
export async function runCycles(task: Task, firstMesh: () => Promise<Mesh>): Promise<CycledMesh> {
  const run = new CycleRun(task);
  const begin = await run.begin(firstMesh);
  return withRun(task.isQuiet, (mesher, controlOf, during) =>
    during(() => run.cycles(mesher, begin, controlOf("adapt"))),
  );
}

interface Begin {
  /** The first mesh, whose boundary all others follow. */
  readonly first: Mesh;
  /** The mesh to be solved next. */
  readonly mesh: Mesh;
  /** Layers of patches that the mesh has. */
  readonly layers: readonly PatchLayers[] | undefined;
  /** What is done. */
  readonly list: CycleList;
}

class CycleRun {
  readonly #task: Task;
  readonly #folder: CycleFolder;
  readonly #formats: Formats;
  readonly #count: number;
  #solverSeconds = 0;

  constructor(task: Task) {
    this.#task = task;
    const { options, chosen } = task;
    this.#folder = new CycleFolder(options.folder ?? defaultFolder(options.output));
    this.#formats = formatsIn(options);
    this.#count = chosen.cycles ?? 1;
  }

  /** Makes the folder and its first mesh, or finds what is done in it. */
  async begin(firstMesh: () => Promise<Mesh>): Promise<Begin> {
    const { input, options } = this.#task;
    await checkInput(input);
    const modelHash = await hashOf(input);
    const known = await resumed(this.#folder, { ...options, input, modelHash });
    const file = this.#folder.file("mesh", 1, KEPT);
    if (known === undefined) {
      const first = await firstMesh();
      const layers = this.#layersOn(first);
      const { solver } = options;
      const list: CycleList = { ...NO_CYCLES, model: path.basename(input), modelHash, solver };
      await this.#folder.create();
      await this.#keep(file, first);
      await this.#folder.write(list);
      return { first, mesh: first, layers, list };
    }
    const done = known.cycles.length;
    print(
      `${input}: ${plural(done, "cycle")} of ${this.#count} in ${this.#folder.folder}; ${this.#continues(done)}`,
    );
    // Mesh files have no faces; the mesh of a CAD file is the same one again.
    const first = isCadInput(input, options.from) ? await firstMesh() : await readMeshFile(file);
    const mesh = done === 0 ? first : await readMeshFile(this.#folder.file("mesh", done + 1, KEPT));
    return { first, mesh, layers: this.#layersOn(first), list: known };
  }

  #layersOn(mesh: Mesh): readonly PatchLayers[] | undefined {
    const { input, chosen } = this.#task;
    return chosen.layers && layersOf(input, mesh, chosen.layers);
  }

  #continues(done: number): string {
    return done < this.#count ? `continuing with cycle ${done + 1}` : "nothing is left to do";
  }

  async cycles(mesher: Mesher, begin: Begin, control: SignalControl): Promise<CycledMesh> {
    const { isQuiet } = this.#task;
    const chosen = { ...this.#task.chosen, layers: begin.layers };
    let { list, mesh } = begin;
    const { length: done } = list.cycles;
    const lines = () => tableLines(list.cycles, chosen.indicator);
    if (!isQuiet) for (const line of lines()) print(line);
    const asked = list.cycles.at(-1)?.targetElements;
    const options = done === 0 ? chosen : { ...chosen, resume: { cycle: done, mesh, asked } };
    const solve = (given: Mesh, { cycle }: SolveContext) => this.#solve(given, cycle, control.signal);
    try {
      let began = performance.now();
      for await (const step of adaptationCycles(mesher, { model: begin.first, solve }, options, control)) {
        const total = (performance.now() - began) / 1000;
        list = { ...list, cycles: [...list.cycles, await this.#kept(step, total)] };
        await this.#folder.write(list);
        mesh = step.next.mesh;
        if (!isQuiet) for (const line of lines().slice(list.cycles.length === 1 ? 0 : -1)) print(line);
        began = performance.now();
      }
    } catch (failure) {
      const isCancelled = failure instanceof MesherError && failure.code === "cancelled";
      if (isCancelled)
        print(`${this.#folder.folder} has ${plural(list.cycles.length, "cycle")}; --resume continues`);
      throw this.#asInput(failure, list.cycles.length + 1);
    }
    return { mesh, cycles: list.cycles, folder: this.#folder.folder };
  }

  /** Writes the files of a cycle; returns its report. */
  async #kept(step: AdaptationCycle, total: number): Promise<CycleReport> {
    const { cycle, next, sizes } = step;
    const { input, isQuiet } = this.#task;
    await this.#keep(this.#folder.file("background", cycle, KEPT), sizes.mesh);
    await this.#keep(this.#folder.file("mesh", cycle + 1, KEPT), next.mesh);
    printDiagnostics(input, [...sizes.diagnostics, ...next.diagnostics], { isQuiet });
    const solver = this.#solverSeconds;
    return reportOf(step, { solver, adaptation: total - solver }, this.#task.chosen);
  }

  async #keep(file: string, mesh: Mesh): Promise<void> {
    await writeMeshTo({ input: this.#task.input, output: file, name: file, isQuiet: true }, mesh);
  }

  async #solve(mesh: Mesh, cycle: number, signal: AbortSignal): Promise<Solution> {
    const { solver } = this.#task.options;
    const { mesh: given, solution } = this.#formats;
    const files: SolverFiles = {
      mesh: this.#folder.file("mesh", cycle, given),
      solution: this.#folder.file("solution", cycle, solution),
      log: this.#folder.file("solver", cycle, ".log"),
      cycle,
    };
    if (given !== KEPT) await this.#keep(files.mesh, mesh);
    enterStage(`cycle ${cycle} of ${this.#count}: running the solver`);
    const began = performance.now();
    await runSolver(solver, files, signal);
    this.#solverSeconds = (performance.now() - began) / 1000;
    return readSolution(files.solution, mesh, this.#namedFields());
  }

  /** Returns the names of the fields that the options name. */
  #namedFields(): readonly string[] {
    const { fields = [], indicator } = this.#task.chosen;
    return decidingNames([], { fields, indicator });
  }

  /** Returns a failure about the solution as one about its file. */
  #asInput(failure: unknown, cycle: number): unknown {
    return asInvalidInput(failure, this.#folder.file("solution", cycle, this.#formats.solution)) ?? failure;
  }
}

type SignalControl = RunControl & { readonly signal: AbortSignal };

/** Extensions of the files that are exchanged with the solver. */
interface Formats {
  readonly mesh: string;
  readonly solution: string;
}

/** Returns the formats of the exchanged files. Throws an InvalidInput. */
function formatsIn({ meshFormat = KEPT, solutionFormat }: CycleCommandOptions): Formats {
  const mesh = extensionOfFormat(meshFormat);
  if (!extensionsFor("write", "volume").includes(mesh)) {
    throw new FileError(
      meshFormat,
      "the format cannot store a volume mesh",
      "Choose another with --mesh-format.",
    );
  }
  const readable = [...extensionsFor("read", "volume"), ...VALUES];
  const own = formatOf(mesh)?.valuesExtension ?? mesh;
  const solution = solutionFormat === undefined ? own : extensionOfSolution(solutionFormat);
  if (readable.includes(solution)) return { mesh, solution };
  const remedy = `Use --solution-format with one of ${readable.join(", ")}.`;
  throw new FileError(solution, "the format of the solution cannot be read", remedy);
}

/** Extensions of files with values alone, in the order of the nodes. */
const VALUES = [".sol", ".solb"];

const extensionOfSolution = (format: string): string =>
  VALUES.find((known) => known.slice(1) === format.toLowerCase().replace(/^\./, "")) ??
  extensionOfFormat(format);

const defaultFolder = (output: string): string =>
  `${output.slice(0, output.length - extensionOf(output).length)}-cycles`;

const NO_CYCLES = { format: "tetrafront-cycles", version: 1, cycles: [] } as const;

interface Resumption extends Pick<CycleCommandOptions, "resume"> {
  readonly input: string;
  readonly modelHash: string;
}

/** Returns what a folder has of this model; undefined for a new folder. Throws an InvalidInput or a FileError. */
async function resumed(
  folder: CycleFolder,
  { resume = false, input, modelHash }: Resumption,
): Promise<CycleList | undefined> {
  const list = await folder.read();
  if (list === undefined) {
    if (!resume) return undefined;
    throw new FileError(folder.list, "there is nothing to resume", "Omit --resume, or set --folder.");
  }
  if (list.modelHash !== modelHash) {
    const message = `the cycles in this folder are of another model than ${input}, or of an earlier version of it`;
    throw new FileError(folder.folder, message, "Delete the folder, or choose another with --folder.");
  }
  if (resume) return list;
  const message = `the folder has ${plural(list.cycles.length, "cycle")} of an earlier run`;
  throw new FileError(
    folder.folder,
    message,
    "Use --resume to continue, delete the folder, or choose another with --folder.",
  );
}

/** Reads the fields that a solver has written, also those with these names; values alone belong to the given mesh. */
async function readSolution(file: string, mesh: Mesh, names: readonly string[]): Promise<Solution> {
  enterStage(`reading ${file}`);
  const isMesh = !VALUES.includes(extensionOf(file));
  const own = isMesh
    ? await readElements(file, {})
    : { ...mesh, nodeData: await readSolFile(file, mesh.points.length / 3) };
  const fields = [...fieldsFor(file, own, undefined), ...fieldsFor(file, own, names)];
  return {
    mesh: own,
    fields: [...new Set(fields.map(({ name }) => name))].flatMap(
      (name) => fields.find((one) => one.name === name) ?? [],
    ),
  };
}

function reportOf(
  { cycle, solution, estimatedErrors, sizes, next }: AdaptationCycle,
  seconds: CycleReport["seconds"],
  chosen: CycleOptions,
): CycleReport {
  const names = decidingNames(solution.fields, chosen);
  const byName = (errors: readonly number[]) =>
    Object.fromEntries(names.map((name, f) => [name, errors[f] ?? 0]));
  const { lengths: _, ...adapted } = next.after;
  return {
    cycle,
    nodes: solution.mesh.points.length / 3,
    elements: solution.mesh.tetrahedra.length / 4,
    estimatedErrors: byName(estimatedErrors),
    expectedErrors: byName(sizes.expectedErrors),
    targetElements: Math.round(sizes.elements),
    adapted,
    ...("layers" in next && { layers: [...next.layers], largestAspect: next.largestAspect }),
    seconds,
  };
}

/** Width of a column; names of fields may be wider. */
const WIDTH = 11;

/** Returns the table of cycles, with its head. */
function tableLines(cycles: readonly CycleReport[], indicator: string | undefined): string[] {
  const [first] = cycles;
  if (first === undefined) return [];
  const names = Object.keys(first.estimatedErrors);
  const columns = [
    ...["cycle", "elements"],
    ...names.map((name) => `${name === indicator ? "largest" : "error of"} ${name}`),
    ...["adapted to", "unit edges", "least quality", "solver s", "adapt s"],
  ];
  const line = (words: readonly string[]) =>
    words.map((word, c) => word.padStart(Math.max(WIDTH, columns[c]?.length ?? 0))).join("  ");
  const rows = cycles.map(({ cycle, elements, estimatedErrors, adapted, seconds }) =>
    line([
      ...[cycle, elements].map(String),
      ...names.map((name) => short(estimatedErrors[name] ?? 0, 3)),
      String(adapted.tetrahedra),
      `${(100 * adapted.unitEdges).toFixed(2)} %`,
      adapted.leastQuality.toFixed(3),
      ...[seconds.solver, seconds.adaptation].map((value) => value.toFixed(1)),
    ]),
  );
  return [line(columns), ...rows];
}

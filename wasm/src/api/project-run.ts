/** What a run of a project is given, and the check of it. */
import { type EntityNamer, gridByIndex } from "../diagnostics/entity-names.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { describeAll } from "../diagnostics/describe.js";
import type { RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import type { BodySurfaceArrays, GridArrays, ModelArrays } from "../generated/constants.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import { projectArrays } from "../project/arrays.js";
import { withNodes } from "../project/grid-arrays.js";
import { projectNamer, withPatchOfTriangle } from "../project/names.js";
import type { Project } from "../project/project-types.js";
import { checkProject } from "./input-checks.js";
import type { ProjectCheck } from "./mesher-interface.js";
import type { MeshOptions, ProjectMeshOptions } from "./option-types.js";
import {
  checkOptions,
  checkProjectOptions,
  engineOptions,
  wantedElements,
  withSettings,
} from "./mesh-options.js";
import { withoutBodyNotes } from "./report.js";

/** Options of a run of a project, with the project's settings. */
export interface SettledRun {
  readonly settled: MeshOptions;
  /** Bodies whose triangles are known. */
  readonly known: readonly PreparedBody[];
  /** Wanted number of elements. */
  readonly elements: number | undefined;
  /** What is wrong with the project or the options; the rest holds without errors only. */
  readonly errors: readonly Diagnostic[];
}

export function settledRun(project: Project, options: ProjectMeshOptions): SettledRun {
  const unusable = [...checkProject(project), ...checkProjectOptions(options)];
  if (unusable.length > 0) return { settled: {}, known: [], elements: undefined, errors: unusable };
  const { preparedBodies: all = [], elementOrder: _, ...own } = options;
  const known = all.filter(({ sizeFactor }) => sizeFactor === undefined);
  const settled = withSettings(own, project);
  return { settled, known, elements: wantedElements(own, project), errors: checkOptions(settled) };
}

/** Returns what a run is given of a valid project, and the names of what its diagnostics are about. */
export function drawnRun(
  project: Project,
  { background }: MeshOptions,
): { readonly model: ModelArrays; readonly grid: GridArrays; readonly name: EntityNamer } {
  const { model, grid } = projectArrays(project);
  const name = projectNamer(project);
  return background === undefined
    ? { model, grid, name }
    : { model, grid: withNodes(grid, background), name: gridByIndex(name) };
}

/** The result for what is refused before the engine sees it. */
export const refused = (diagnostics: readonly Diagnostic[]): ProjectCheck => ({
  isFillable: false,
  expectedTetrahedra: null,
  diagnostics,
});

const noBodySurfaces = (): BodySurfaceArrays => ({
  points: new Float64Array(),
  triangles: new Uint32Array(),
  trianglePatch: new Uint32Array(),
  patches: 0,
});

/** Checks a valid project with valid options, as a run begins. */
export async function checkedRun(
  client: EngineClient,
  {
    project,
    options,
    bodies,
  }: {
    readonly project: Project;
    readonly options: MeshOptions;
    readonly bodies?: BodySurfaceArrays | undefined;
  },
  control: RunControl,
): Promise<ProjectCheck> {
  const { model, grid, name } = drawnRun(project, options);
  const given = [model, bodies ?? noBodySurfaces(), grid, engineOptions(options)] as const;
  const { isFillable, ...found } = await client.ask("checkRun", given, control);
  const named = bodies === undefined ? name : withPatchOfTriangle(name, found.trianglePatch);
  const diagnostics = withoutBodyNotes(describeAll(found.diagnostics, named), project);
  const tooMany = diagnostics.find(({ code }) => code === "too-many-elements");
  const expected = tooMany?.code === "too-many-elements" ? tooMany.data.expected : found.expectedTetrahedra;
  return { isFillable, expectedTetrahedra: expected > 0 ? expected : null, diagnostics };
}

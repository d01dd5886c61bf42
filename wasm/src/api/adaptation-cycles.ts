/** Adapts the mesh of a model to the solution of a solver, cycle by cycle. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { throwIfCancelled, untilCancelled } from "../calls/cancelling.js";
import { objectWith } from "../calls/schemas.js";
import { shown } from "../base/values.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { cancelledError, refuse } from "../diagnostics/mesher-error.js";
import { invalidArrays, invalidOption } from "../diagnostics/package-diagnostic.js";
import type { RunControl } from "../engine/control.js";
import { listed, numbered } from "../formats/groups.js";
import type { AdaptationCycle, Solution, Solve, SolvedFields } from "../mesh/adaptation-cycle.js";
import { dataOf, fieldsOf } from "../mesh/mesh-fields.js";
import type { Mesh, SurfaceInput, VolumeInput } from "../mesh/mesh.js";
import type { MeshResult } from "../mesh/report.js";
import type { FieldValues } from "../mesh/solution.js";
import type { Project } from "../project/project-types.js";
import { checkControl, checkImproveInput } from "./input-checks.js";
import { checkAdaptOptions } from "./mesh-options.js";
import { correctedNumber } from "./corrected-number.js";
import type { Mesher } from "./mesher-interface.js";
import { checkLayerOptions, checkLayers, requirePatches } from "./layers.js";
import type { CycleOptions, LayerOptions, SolutionSizeOptions } from "./option-types.js";
import { checkAgainst, option, wholeWithin } from "./option-schema.js";
import { completeVolume } from "./solution.js";
import { estimatedErrors } from "./solution-error.js";
import { checkSolutionSizeOptions, DEFAULT_NORM } from "./solution-options.js";
import { WholeProgress } from "./whole-progress.js";

export const DEFAULT_CYCLES = 3;
const MAX_CYCLES = 1000;

const cycleSchema = objectWith({
  cycles: option(
    "number of cycles",
    `a whole number from 1 to ${MAX_CYCLES}`,
    wholeWithin(1, MAX_CYCLES),
    DEFAULT_CYCLES,
  ),
  fields: option(
    "list of fields",
    "a list of at least one name",
    v.pipe(v.array(v.string()), v.minLength(1)),
    undefined,
  ),
  resume: option(
    "state to resume",
    "the number of the last cycle and the mesh that it made",
    v.object({
      cycle: wholeWithin(1, MAX_CYCLES),
      mesh: v.looseObject({}),
      asked: v.optional(v.pipe(v.number(), v.finite(), v.minValue(1))),
    }),
    undefined,
  ),
});

/** What a solution is made on. */
export type AdaptedModel = Project | SurfaceInput | VolumeInput;

/** Shares of a cycle in the work that is left of it, without the solver's. */
const SHARES = { sizes: 0.2, adapt: 0.9, transfer: 1 } as const;

/** Returns the problems of the options of `adapt`. */
export function checkCycleOptions(options: CycleOptions): Diagnostic[] {
  if (typeof options !== "object" || (options as unknown) === null) return checkAgainst(options, cycleSchema);
  const { cycles, fields, resume, layers, leastQuality, sweeps, conservative: _, ...sizes } = options;
  return [
    ...checkAgainst({ cycles, fields, resume }, cycleSchema),
    ...(layers === undefined ? [] : [...checkLayers(layers), ...checkLayerOptions(layerLimits(sizes))]),
    ...checkAdaptOptions({ leastQuality, sweeps }),
    ...checkSolutionSizeOptions(sizes),
  ];
}

/** Returns the limits of the sizes that layers have too. */
const layerLimits = ({ maxAspect, growth }: SolutionSizeOptions): LayerOptions => ({ maxAspect, growth });

/** Implements `Mesher.adapt`. */
export async function* adaptationCycles(
  mesher: Mesher,
  { model, solve }: { readonly model: AdaptedModel; readonly solve: Solve },
  options: CycleOptions,
  control: RunControl,
): AsyncGenerator<AdaptationCycle, void> {
  refuse(checkControl(control));
  checkArgument("solve", solve, v.function());
  checkArgument("model", model, v.looseObject({}));
  refuse(checkCycleOptions(options));
  const { cycles = DEFAULT_CYCLES, resume } = options;
  const whole = new WholeProgress(control);
  if (resume !== undefined) refuse(checkImproveInput(resume.mesh));
  const first = await firstMesh(mesher, model, whole.next(FIRST_SHARE / cycles));
  if (options.layers !== undefined) requirePatches(first, options.layers);
  const { elementData } = resume?.mesh ?? {};
  let mesh = resume === undefined ? first : { ...completeVolume(resume.mesh), elementData };
  let start: readonly FieldValues[] = resume === undefined ? [] : fieldsOf(mesh);
  let { asked } = resume ?? {};
  for (let cycle = (resume?.cycle ?? 0) + 1; cycle <= cycles; cycle++) {
    throwIfCancelled(control.signal);
    const { signal } = control;
    const solved = await untilCancelled(() => solve(mesh, { cycle, start, signal }), signal);
    const progress = new WholeProgress(whole.next(1 / (cycles - cycle + 1)));
    const solution = checkedSolution(solved, mesh);
    const corrected = { ...options, elements: correctedNumber(options.elements, mesh, asked) };
    const made = await followed(mesher, { first, solution }, corrected, progress);
    yield { cycle, mesh, ...made };
    asked = made.sizes.elements;
    mesh = made.next.mesh;
    start = made.transferred.fields;
  }
}

/** Share of a cycle's work in the meshing of the model. */
const FIRST_SHARE = 0.5;

/** Returns the mesh of a model, with its boundary. */
async function firstMesh(mesher: Mesher, model: AdaptedModel, control: RunControl): Promise<Mesh> {
  if ("lines" in model) return meshOf(await mesher.meshProject(model, {}, control), control);
  const { tetrahedra, triangles } = model;
  if (tetrahedra == null || !(tetrahedra.length > 0)) {
    const surface: SurfaceInput = { ...model, triangles: triangles ?? new Uint32Array() };
    return meshOf(await mesher.meshSurface(surface, { surface: "remesh" }, control), control);
  }
  const volume = { ...model, tetrahedra };
  refuse(checkImproveInput(volume));
  if (triangles !== undefined && triangles.length > 0) return completeVolume(volume);
  const { boundary } = await mesher.inspectMesh(volume, control);
  const { triangles: faces, region: trianglePatch } = boundary;
  const patches = numbered("boundary", model.regions?.length ?? 1);
  return completeVolume({ ...volume, triangles: faces, trianglePatch, patches });
}

function meshOf({ mesh, report }: MeshResult, { signal }: RunControl): Mesh {
  if (report.status === "cancelled" && signal !== undefined) throw cancelledError(signal);
  if (report.status !== "done") refuse(report.diagnostics);
  return mesh;
}

interface Given {
  readonly first: Mesh;
  readonly solution: SolvedFields;
}

/** Makes the next mesh, which follows the solution, and transfers the solution to it. */
async function followed(
  mesher: Mesher,
  { first, solution }: Given,
  options: CycleOptions,
  progress: WholeProgress,
): Promise<Omit<AdaptationCycle, "cycle" | "mesh">> {
  const { cycles: _c, resume: _r, fields: names, conservative, ...others } = options;
  const { layers, leastQuality, sweeps, ...sizing } = others;
  const { norm = DEFAULT_NORM, indicator } = sizing;
  const { fields, mesh } = solution;
  const deciding = decidingFields(fields, { fields: names, indicator });
  const sizes = await mesher.sizeFromSolution(mesh, deciding, sizing, progress.next(SHARES.sizes));
  const errors = await estimatedErrors(mesher, mesh, { fields: deciding, norm, indicator }, () =>
    progress.next(SHARES.sizes),
  );
  const control = progress.next(SHARES.adapt);
  const limits = { leastQuality, sweeps };
  const next =
    layers === undefined
      ? await mesher.adaptMesh(first, sizes.mesh, limits, control)
      : await mesher.addLayers(
          first,
          layers,
          { ...limits, ...layerLimits(sizing), background: sizes.mesh },
          control,
        );
  const transferred = await mesher.transferSolution(
    mesh,
    next.mesh,
    fields,
    { conservative },
    progress.next(SHARES.transfer),
  );
  return {
    solution,
    estimatedErrors: errors,
    sizes,
    next: { ...next, mesh: { ...next.mesh, ...dataOf(transferred.fields) } },
    transferred,
  };
}

const solutionSchema = v.union([
  v.array(v.looseObject({})),
  v.looseObject({ fields: v.array(v.looseObject({})) }),
]);

/** Returns what a solver returned, with its mesh, and a name for each field. Rejects other values. */
function checkedSolution(solved: unknown, mesh: Mesh): SolvedFields {
  if (!v.is(solutionSchema, solved)) {
    const message = `the solver returned ${shown(solved)}, not a list of fields`;
    refuse([invalidArrays(message, "Return a list of fields with `components` and `values`.")]);
  }
  const given = solved as readonly FieldValues[] | Solution;
  const { fields, mesh: own }: Solution = "fields" in given ? given : { fields: given };
  return {
    mesh: own ?? mesh,
    fields: fields.map((field, f) => ({ ...field, name: field.name ?? `field ${f + 1}` })),
  };
}

/**
 * Returns the names of the fields that decide the sizes: of all by default, of the indicator alone if there is one. The indicator
 * is the last.
 */
export function decidingNames(
  fields: readonly FieldValues[],
  { fields: names, indicator }: Pick<CycleOptions, "fields" | "indicator">,
): readonly string[] {
  if (indicator === undefined) return names ?? fields.map(({ name = "" }) => name);
  return [...(names ?? []).filter((name) => name !== indicator), indicator];
}

/** Returns the fields that decide the sizes. Rejects a name that no field has. */
function decidingFields(
  fields: readonly FieldValues[],
  options: Pick<CycleOptions, "fields" | "indicator">,
): readonly FieldValues[] {
  return decidingNames(fields, options).flatMap((name) => {
    const field = fields.find((one) => one.name === name);
    if (field !== undefined) return [field];
    const known = listed(fields.map((one) => `"${one.name ?? ""}"`));
    const option = name === options.indicator ? "indicator" : "fields";
    refuse([invalidOption(option, `the solution has no field "${name}"`, `Use one of ${known}.`)]);
    return [];
  });
}

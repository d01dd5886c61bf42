/** Options of the calls that make or improve tetrahedra: schemas, checks, and the engine's form. */
import * as v from "valibot";
import { numbersOf } from "../base/enums.js";
import { LIMITS } from "../base/limits.js";
import { asObject } from "../base/values.js";
import { doubles, index, integers, objectWith } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { EngineOptions, EngineImproveOptions } from "../engine/loader.js";
import {
  ADAPT_DEFAULTS,
  FRONT_ORDERS,
  IMPROVE_DEFAULTS,
  INTERIORS,
  MESH_DEFAULTS,
  OPTIMIZATIONS,
} from "../generated/constants.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import { hasSourcesOnly } from "../project/background-arrays.js";
import type { Project } from "../project/project-types.js";
import {
  option,
  type EntriesOf,
  within,
  wholeWithin,
  growthOption,
  choiceOption,
  switchOption,
  shared,
  checkAgainst,
  checkWithBackground,
  finiteGrowth,
  INNER_SHELL_NUMBERS,
} from "./option-schema.js";
import type {
  AdaptOptions,
  ImproveOptions,
  MeshOptions,
  OrderOptions,
  PreviewOptions,
  ProjectMeshOptions,
  RefineOptions,
} from "./option-types.js";

const FRONT_ORDER_NUMBERS = numbersOf(FRONT_ORDERS);
const OPTIMIZATION_NUMBERS = numbersOf(OPTIMIZATIONS);
const INTERIOR_NUMBERS = numbersOf(INTERIORS);

const elementsOption = option(
  "number of elements",
  `a whole number from 1 to ${MESH_DEFAULTS.maxTetrahedra}`,
  wholeWithin(1, MESH_DEFAULTS.maxTetrahedra),
  undefined,
);

const meshEntries = {
  size: shared.size,
  elements: elementsOption,
  background: shared.background,
  growth: growthOption(MESH_DEFAULTS.growth),
  maxVolume: shared.maxVolume,
  innerShells: shared.innerShells,
  order: choiceOption("order of the front", FRONT_ORDERS, MESH_DEFAULTS.order),
  optimization: choiceOption("optimization", OPTIMIZATIONS, MESH_DEFAULTS.optimization),
  interior: choiceOption("interior", INTERIORS, MESH_DEFAULTS.interior),
  filters: switchOption("choice of filters", MESH_DEFAULTS.filters),
  threads: option(
    "number of threads",
    `a whole number from 1 to ${LIMITS.threads}`,
    wholeWithin(1, LIMITS.threads),
    undefined,
  ),
  exactFillOnly: switchOption("choice of the exact fill alone", MESH_DEFAULTS.exactFillOnly),
} satisfies EntriesOf<MeshOptions>;

const meshSchema = objectWith(meshEntries);

const noEdges = { edges: new Uint32Array(), middles: new Float64Array() };

const preparedList = v.array(
  v.pipe(
    v.object({
      body: index,
      points: doubles(3),
      triangles: integers(3),
      trianglePatch: integers(),
      trueEdges: v.optional(v.object({ edges: integers(2), middles: doubles(3) })),
      diagnostics: v.array(v.object({ severity: v.string() })),
    }),
    v.check(({ triangles, trianglePatch }) => triangles.length === 3 * trianglePatch.length),
    v.check(({ points, trueEdges: { edges, middles } = noEdges }) => {
      const nodes = points.length / 3;
      const isComplete = 3 * edges.length === 2 * middles.length;
      return isComplete && edges.every((node) => node < nodes) && middles.every(Number.isFinite);
    }),
  ),
);

const orderOption = option("order of the elements", "1 or 2", v.picklist([1, 2]), undefined);

const orderSchema = objectWith({ elementOrder: orderOption } satisfies EntriesOf<OrderOptions>);

const projectMeshSchema = objectWith({
  ...meshEntries,
  elementOrder: orderOption,
  preparedBodies: option(
    "list of prepared bodies",
    "a list of results of prepareBody",
    v.custom<readonly PreparedBody[]>((value) => v.is(preparedList, value)),
    undefined,
  ),
} satisfies EntriesOf<ProjectMeshOptions>);

const { elements: _noElements, threads: _noThreads, ...refineEntries } = meshEntries;

const refineSchema = objectWith({
  ...refineEntries,
  volume: option(
    "volume",
    "the enclosed volume, as inspectSurface returns it",
    within(0, Number.MAX_VALUE),
    undefined,
  ),
} satisfies EntriesOf<RefineOptions>);

const previewSchema = objectWith({
  size: shared.size,
  innerShells: shared.innerShells,
  background: shared.background,
  samplesOnly: switchOption("choice of sampling only", false),
} satisfies EntriesOf<PreviewOptions>);

export const IMPROVEMENT_LEVELS = ["fast", "default", "thorough"] as const;

const improveSchema = objectWith({
  optimization: choiceOption("optimization", IMPROVEMENT_LEVELS, "default"),
  maxGrowth: option(
    "largest growth of the number of elements",
    `a fraction from 0 to ${LIMITS.elementGrowth}, for example ${IMPROVE_DEFAULTS.maxGrowth}`,
    within(0, LIMITS.elementGrowth),
    IMPROVE_DEFAULTS.maxGrowth,
  ),
} satisfies EntriesOf<ImproveOptions>);

/** Entries of the options of every adaptation. */
export const adaptEntries = {
  leastQuality: option("least quality", "a number from 0 to 1", within(0, 1), ADAPT_DEFAULTS.leastQuality),
  sweeps: option(
    "number of sweeps",
    "a whole number from 0 to 100",
    wholeWithin(0, 100),
    ADAPT_DEFAULTS.sweeps,
  ),
} satisfies EntriesOf<AdaptOptions>;

const adaptSchema = objectWith(adaptEntries);

export function checkAdaptOptions(options: AdaptOptions): Diagnostic[] {
  return checkAgainst(options, adaptSchema);
}

/** Checks the options of a mesh. `others`: names of further options, which the caller has checked. */
export function checkOptions(options: MeshOptions, others: readonly string[] = []): Diagnostic[] {
  return [...checkWithBackground(options, meshSchema, others), ...twoSizes(options)];
}

/** Checks the order of elements. */
export const checkOrder = ({ elementOrder }: OrderOptions): Diagnostic[] =>
  checkAgainst({ elementOrder }, orderSchema);

export function checkProjectOptions(options: ProjectMeshOptions): Diagnostic[] {
  return [...checkWithBackground(options, projectMeshSchema), ...twoSizes(options)];
}

/** Returns an error about a size beside a number of elements. */
export function excludedSize(option: "size" | "minSize" | "maxSize"): Diagnostic {
  const message = `\`elements\` and \`${option}\` exclude each other`;
  return invalidOption("elements", message, `Omit \`${option}\`: the number of elements decides the sizes.`);
}

/** Returns an error if both a size and a number of elements are given. */
function twoSizes(options: MeshOptions): Diagnostic[] {
  const { size, elements } = asObject(options) as typeof options;
  if (size === undefined || elements === undefined) return [];
  return [excludedSize("size")];
}

export const checkRefineOptions = (options: RefineOptions): Diagnostic[] =>
  checkWithBackground(options, refineSchema);

export function checkPreviewOptions(options: PreviewOptions): Diagnostic[] {
  return checkWithBackground(options, previewSchema);
}

export function checkImproveOptions(options: ImproveOptions): Diagnostic[] {
  return checkAgainst(options, improveSchema);
}

/**
 * Adds the project's own settings to options that the caller omits. A background grid of the caller also replaces
 * the project's uniform size. The number of elements is left out: see `wantedElements`.
 */
export function withSettings(options: MeshOptions, { meshing }: Project): MeshOptions {
  if (meshing === undefined) return { ...options, elements: undefined };
  const { elements: _elements, ...own } = options;
  const given = Object.entries(own).filter(([, value]) => value !== undefined);
  const { background } = options;
  const keepsSize = background === undefined || hasSourcesOnly(background);
  const { elements: _ofProject, gradation, ...others } = meshing;
  const growth = gradation === undefined ? {} : { growth: growthOf(gradation) };
  const settings = { ...others, ...growth, ...(!keepsSize && { size: undefined }) };
  return { ...settings, ...Object.fromEntries(given) };
}

/** Returns a diagnostic if a ratio of the sizes of neighbouring elements is invalid. */
export function checkGradation(gradation: number, name = "gradation"): Diagnostic[] {
  if (gradation === 0 || (gradation > 1 && gradation <= LIMITS.gradation)) return [];
  const remedy = `Use 0, or a gradation above 1 and up to ${LIMITS.gradation}, such as ${MESH_DEFAULTS.gradation}.`;
  return [invalidOption(name, `the gradation is ${gradation}`, remedy)];
}

/** Returns the growth per unit of distance for a ratio of the sizes of neighbouring elements; 0 means no limit. */
export const growthOf = (gradation: number): number => (gradation === 0 ? Infinity : gradation - 1);

/** The engine's ratio for a growth; it must be above 1. */
const gradationOf = (growth: number): number =>
  growth === Infinity ? 0 : Math.min(LIMITS.gradation, 1 + Math.max(Number.EPSILON, growth));

/** Returns the number of elements that a mesh of a project is to have: that of the caller, whose size would replace the project's. */
export function wantedElements({ elements, size }: MeshOptions, { meshing }: Project): number | undefined {
  return elements ?? (size === undefined ? meshing?.elements : undefined);
}

/** Converts valid options; a size of 0 means none. */
export function engineOptions(options: MeshOptions): EngineOptions {
  const parsed = v.parse(meshSchema, options);
  const {
    background: _,
    elements: _elements,
    threads: _threads,
    size = MESH_DEFAULTS.size,
    maxVolume = MESH_DEFAULTS.maxVolume,
    growth,
    ...chosen
  } = parsed;
  return {
    ...chosen,
    growth: finiteGrowth(growth),
    gradation: gradationOf(growth),
    size,
    maxVolume,
    innerShells: INNER_SHELL_NUMBERS[chosen.innerShells],
    order: FRONT_ORDER_NUMBERS[chosen.order],
    optimization: OPTIMIZATION_NUMBERS[chosen.optimization],
    interior: INTERIOR_NUMBERS[chosen.interior],
    maxTetrahedra: LIMITS.tetrahedra,
  };
}

/** Converts valid options. */
export function engineImproveOptions(options: ImproveOptions): EngineImproveOptions {
  const { optimization, maxGrowth } = v.parse(improveSchema, options);
  return { optimization: OPTIMIZATION_NUMBERS[optimization], maxGrowth };
}

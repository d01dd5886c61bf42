/** Options of the calls: a schema for each options object, with limits and defaults, and the engine's form of it. */
import * as v from "valibot";
import { numbersOf } from "../base/enums.js";
import { LIMITS, limitText } from "../base/limits.js";
import { asObject, shown } from "../base/values.js";
import { doubles, index, integers, objectWith } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type {
  EngineInspectionOptions,
  EngineOptions,
  EngineProposalOptions,
  EngineImproveOptions,
  EngineRemeshOptions,
  EngineRepairOptions,
} from "../engine/loader.js";
import {
  COVER_SHAPES,
  type CoverShape,
  FRONT_ORDERS,
  IMPROVE_DEFAULTS,
  INNER_SHELLS,
  INSPECTION_DEFAULTS,
  MAX_HOLE_EDGES,
  MAX_LAYERS,
  MAX_LENGTH,
  MAX_REMESH_ANGLE,
  MAX_SIZE_FACTOR,
  MESH_DEFAULTS,
  MIN_LENGTH,
  MIN_REMESH_ANGLE,
  MIN_SIZE_FACTOR,
  OPTIMIZATIONS,
  PROPOSAL_DEFAULTS,
  REMESH_DEFAULTS,
  REPAIR_DEFAULTS,
} from "../generated/constants.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import { type BackgroundArrays, checkBackground, hasSourcesOnly } from "../project/background-arrays.js";
import type { Project } from "../project/project-types.js";
import type {
  CoverOptions,
  ImproveOptions,
  InspectionOptions,
  MeshOptions,
  PreviewOptions,
  ProjectMeshOptions,
  ProposalOptions,
  RefineOptions,
  RemeshOptions,
  RepairOptions,
  SplitOptions,
  SurfaceProposalOptions,
} from "./option-types.js";

const INNER_SHELL_NUMBERS = numbersOf(INNER_SHELLS);
const FRONT_ORDER_NUMBERS = numbersOf(FRONT_ORDERS);
const OPTIMIZATION_NUMBERS = numbersOf(OPTIMIZATIONS);
const COVER_SHAPE_NUMBERS = numbersOf(COVER_SHAPES);
export const DEFAULT_COVER_SHAPE: CoverShape = "box";

/** Words for an option in messages: its name, and the values that it accepts. */
interface OptionWords {
  readonly label: string;
  readonly expected: string;
}

/** An option that may be omitted; `otherwise` is its default. */
function option<const Schema extends v.GenericSchema, const Default extends v.InferInput<Schema> | undefined>(
  label: string,
  expected: string,
  schema: Schema,
  otherwise: Default,
) {
  const words: OptionWords = { label, expected };
  return v.optional(v.pipe(schema, v.metadata({ words })), otherwise);
}

/** One schema per option of an interface, and no others. */
type EntriesOf<Options> = { readonly [Name in keyof Options]-?: v.GenericSchema<Options[Name], unknown> };

const within = (min: number, max: number) => v.pipe(v.number(), v.minValue(min), v.maxValue(max));
const wholeWithin = (min: number, max: number) => v.pipe(within(min, max), v.integer());

const sizeOption = (label: string) =>
  option(
    label,
    `a size from ${limitText(MIN_LENGTH)} to ${limitText(MAX_LENGTH)}, in model units`,
    within(MIN_LENGTH, MAX_LENGTH),
    undefined,
  );
const growthOption = (otherwise: number) =>
  option(
    "growth",
    `a growth from 0 to ${LIMITS.growth}, for example ${MESH_DEFAULTS.growth}, or Infinity for no limit`,
    v.union([within(0, LIMITS.growth), v.literal(Infinity)]),
    otherwise,
  );
function choiceOption<const Choice extends string>(
  label: string,
  choices: readonly Choice[],
  otherwise: NoInfer<Choice>,
) {
  return option(label, `one of ${choices.join(", ")}`, v.picklist(choices), otherwise);
}
const switchOption = (label: string, otherwise: boolean) =>
  option(label, "true or false", v.boolean(), otherwise);

/** Checked together with the size by `checkBackground`. */
const background = v.optional(v.custom<BackgroundArrays>(() => true));
const innerShells = choiceOption("meaning of inner shells", INNER_SHELLS, MESH_DEFAULTS.innerShells);

const elementsOption = option(
  "number of elements",
  `a whole number from 1 to ${MESH_DEFAULTS.maxTetrahedra}`,
  wholeWithin(1, MESH_DEFAULTS.maxTetrahedra),
  undefined,
);

const meshEntries = {
  size: sizeOption("element size"),
  elements: elementsOption,
  background,
  growth: growthOption(MESH_DEFAULTS.growth),
  maxVolume: option(
    "largest volume of a tetrahedron",
    "a volume above 0, in cubed model units",
    v.pipe(v.number(), v.gtValue(0), v.finite()),
    undefined,
  ),
  innerShells,
  order: choiceOption("order of the front", FRONT_ORDERS, MESH_DEFAULTS.order),
  optimization: choiceOption("optimization", OPTIMIZATIONS, MESH_DEFAULTS.optimization),
  filters: switchOption("choice of filters", MESH_DEFAULTS.filters),
  exactFillOnly: switchOption("choice of the exact fill alone", MESH_DEFAULTS.exactFillOnly),
} satisfies EntriesOf<MeshOptions>;
const meshSchema = objectWith(meshEntries);

const preparedList = v.array(
  v.pipe(
    v.object({
      body: index,
      points: doubles(3),
      triangles: integers(3),
      trianglePatch: integers(),
      diagnostics: v.array(v.object({ severity: v.string() })),
    }),
    v.check(({ triangles, trianglePatch }) => triangles.length === 3 * trianglePatch.length),
  ),
);
const projectMeshSchema = objectWith({
  ...meshEntries,
  preparedBodies: option(
    "list of prepared bodies",
    "a list of results of prepareBody",
    v.custom<readonly PreparedBody[]>((value) => v.is(preparedList, value)),
    undefined,
  ),
} satisfies EntriesOf<ProjectMeshOptions>);

const { elements: _noElements, ...refineEntries } = meshEntries;
const refineSchema = objectWith({
  ...refineEntries,
  volume: option(
    "volume",
    "the enclosed volume, as inspectSurface returns it",
    within(0, Number.MAX_VALUE),
    undefined,
  ),
} satisfies EntriesOf<RefineOptions>);

const distanceOption = (label: string) =>
  option(
    label,
    `a distance from ${limitText(MIN_LENGTH)} to ${limitText(MAX_LENGTH)}, in model units`,
    within(MIN_LENGTH, MAX_LENGTH),
    undefined,
  );
const angleOption = (label: string, otherwise: number | undefined) =>
  option(
    label,
    `an angle from ${MIN_REMESH_ANGLE} to ${MAX_REMESH_ANGLE} degrees`,
    within(MIN_REMESH_ANGLE, MAX_REMESH_ANGLE),
    otherwise,
  );
const remeshEntries = {
  size: meshEntries.size,
  minSize: sizeOption("smallest size"),
  maxSize: sizeOption("largest size"),
  tolerance: distanceOption("tolerance"),
  featureAngle: angleOption("feature angle", REMESH_DEFAULTS.featureAngle),
  anglePerEdge: angleOption("angle per edge", undefined),
  layers: option("number of layers", `a number from 0 to ${MAX_LAYERS}`, within(0, MAX_LAYERS), undefined),
  dropDetails: option(
    "length of dropped details",
    `0 or a distance from ${limitText(MIN_LENGTH)} to ${limitText(MAX_LENGTH)}, in model units`,
    v.union([v.literal(0), within(MIN_LENGTH, MAX_LENGTH)]),
    undefined,
  ),
  sizeFactor: option(
    "factor on the sizes",
    `a factor from ${MIN_SIZE_FACTOR} to ${MAX_SIZE_FACTOR}`,
    within(MIN_SIZE_FACTOR, MAX_SIZE_FACTOR),
    REMESH_DEFAULTS.sizeFactor,
  ),
  growth: growthOption(REMESH_DEFAULTS.growth),
  maxVolume: meshEntries.maxVolume,
  innerShells,
  background,
} satisfies EntriesOf<RemeshOptions>;
const remeshSchema = objectWith(remeshEntries);

const { background: _noBackground, dropDetails: _noDropping, ...proposalEntries } = remeshEntries;
const surfaceProposalSchema = objectWith(proposalEntries satisfies EntriesOf<SurfaceProposalOptions>);

const splitSchema = objectWith({
  angle: angleOption("angle between patches", REMESH_DEFAULTS.featureAngle),
  patches: option(
    "list of patches to split",
    "a list of patch indices, counted from 0",
    v.custom<readonly number[]>((value) => v.is(v.array(index), value)),
    undefined,
  ),
} satisfies EntriesOf<SplitOptions>);

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

const previewSchema = objectWith({
  size: meshEntries.size,
  innerShells,
  background,
  samplesOnly: switchOption("choice of sampling only", false),
} satisfies EntriesOf<PreviewOptions>);

const inspectionSchema = objectWith({
  innerShells,
  maxDiagnostics: option(
    "number of diagnostics to list",
    `a whole number from 1 to ${LIMITS.maxDiagnostics}`,
    wholeWithin(1, LIMITS.maxDiagnostics),
    INSPECTION_DEFAULTS.maxDiagnostics,
  ),
} satisfies EntriesOf<InspectionOptions>);

const coverSchema = objectWith({
  size: meshEntries.size,
  shape: choiceOption("shape", COVER_SHAPES, DEFAULT_COVER_SHAPE),
} satisfies EntriesOf<CoverOptions>);

/** Largest number of elements around a circle, and across a gap, in a proposal. */
const MAX_PROPOSED = 1000;
const proposalSchema = objectWith({
  maxSize: remeshEntries.maxSize,
  minSize: remeshEntries.minSize,
  anglePerEdge: option(
    "angle per edge",
    `0, or an angle from ${360 / MAX_PROPOSED} to 360 degrees; 0 omits it`,
    v.union([v.literal(0), within(360 / MAX_PROPOSED, 360)]),
    360 / PROPOSAL_DEFAULTS.elementsPerCircle,
  ),
  layers: option(
    "number of layers",
    `a number from 0 to ${MAX_PROPOSED}; 0 omits it`,
    within(0, MAX_PROPOSED),
    PROPOSAL_DEFAULTS.elementsPerGap,
  ),
  growth: growthOption(PROPOSAL_DEFAULTS.growth),
} satisfies EntriesOf<ProposalOptions>);

const repairSchema = objectWith({
  innerShells,
  weld: option(
    "weld distance",
    `a distance from 0 to ${limitText(MAX_LENGTH)}, in model units`,
    v.union([v.literal(false), within(0, MAX_LENGTH)]),
    REPAIR_DEFAULTS.weldDistance,
  ),
  removeTriangles: switchOption("choice of removing triangles", REPAIR_DEFAULTS.removeTriangles),
  fillHoles: option(
    "number of edges of holes to fill",
    `a whole number from 0 to ${MAX_HOLE_EDGES}`,
    wholeWithin(0, MAX_HOLE_EDGES),
    REPAIR_DEFAULTS.maxHoleEdges,
  ),
  orient: switchOption("choice of orienting triangles", REPAIR_DEFAULTS.orient),
  weldIntersections: option(
    "weld distance of intersections",
    `0 or a distance up to ${limitText(MAX_LENGTH)}, in model units`,
    within(0, MAX_LENGTH),
    0,
  ),
  resolveIntersections: switchOption(
    "choice of resolving intersections",
    REPAIR_DEFAULTS.resolveIntersections,
  ),
} satisfies EntriesOf<RepairOptions>);

const gridSchema = objectWith({ sizes: v.optional(v.unknown()) });

/** Checks the options of a mesh. `others`: names of further options, which the caller has checked. */
export function checkOptions(options: MeshOptions, others: readonly string[] = []): Diagnostic[] {
  return [...checkWithBackground(options, meshSchema, others), ...twoSizes(options)];
}

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

export function checkSurfaceProposalOptions(options: SurfaceProposalOptions): Diagnostic[] {
  const wrong = checkAgainst(options, surfaceProposalSchema);
  return wrong.length > 0 ? wrong : checkRemeshOptions(options);
}

export function checkRemeshOptions(options: RemeshOptions): Diagnostic[] {
  const wrong = checkWithBackground(options, remeshSchema);
  if (wrong.length > 0) return wrong;
  const { size, minSize, maxSize, background } = options;
  if (maxSize !== undefined && (size !== undefined || (background && !hasSourcesOnly(background)))) {
    const message = "a largest size is given together with an element size or a background grid";
    return [invalidOption("maxSize", message, "Omit the largest size: it limits automatic sizes only.")];
  }
  const largest = size ?? maxSize ?? Infinity;
  if (minSize === undefined || minSize <= largest) return [];
  const message = `the smallest size, ${minSize}, is larger than the largest, ${largest}`;
  return [invalidOption("minSize", message, "Use a smaller one, or omit it.")];
}

export function checkSplitOptions(options: SplitOptions): Diagnostic[] {
  return checkAgainst(options, splitSchema);
}

export function checkImproveOptions(options: ImproveOptions): Diagnostic[] {
  return checkAgainst(options, improveSchema);
}

export function checkPreviewOptions(options: PreviewOptions): Diagnostic[] {
  return checkWithBackground(options, previewSchema);
}

export function checkInspectionOptions(options: InspectionOptions): Diagnostic[] {
  return checkAgainst(options, inspectionSchema);
}

export function checkCoverOptions(options: CoverOptions): Diagnostic[] {
  return checkAgainst(options, coverSchema);
}

/** Checks the options of `backgroundFromMesh`; the sizes are checked together with the mesh. */
export function checkGridOptions(options: { readonly sizes?: unknown }): Diagnostic[] {
  return checkAgainst(options, gridSchema);
}

export function checkProposalOptions(options: ProposalOptions): Diagnostic[] {
  return checkAgainst(options, proposalSchema);
}

export function checkRepairOptions(options: RepairOptions): Diagnostic[] {
  return checkAgainst(options, repairSchema);
}

type SizeOptions = Pick<MeshOptions, "size" | "background">;

function checkWithBackground(
  options: SizeOptions,
  schema: OptionsSchema,
  others: readonly string[] = [],
): Diagnostic[] {
  const wrong = checkAgainst(options, schema, others);
  const { size, background } = asObject(options) as typeof options;
  if (background === undefined) return wrong;
  if (size !== undefined && !hasSourcesOnly(background)) {
    const message = "both an element size and a background grid are given";
    wrong.push(invalidOption("background", message, "Pass one of them: a size, or a background grid."));
  }
  return [...wrong, ...checkBackground(background)];
}

type OptionsSchema = v.StrictObjectSchema<v.ObjectEntries, undefined>;

/** Returns one diagnostic per invalid option; for unknown options, one for the first. */
function checkAgainst(options: unknown, schema: OptionsSchema, others: readonly string[] = []): Diagnostic[] {
  const parsed = v.safeParse(schema, options, { abortPipeEarly: true });
  if (parsed.success) return [];
  return parsed.issues.map(({ path, input, expected }) => {
    const name = path?.[0].key;
    if (typeof name !== "string") {
      return invalidOption("options", `the options are ${shown(input)}`, "Pass an object, or omit them.");
    }
    const known = Object.keys(schema.entries);
    if (expected === "never" && !known.includes(name)) {
      const remedy = `Correct its name: the options are ${[...known, ...others].join(", ")}.`;
      return invalidOption(name, `there is no option "${name}"`, remedy);
    }
    const { label, expected: permitted } = wordsOf(schema.entries[name], name);
    return invalidOption(name, `the ${label} is ${shown(input)}`, `Use ${permitted}.`);
  });
}

function wordsOf(schema: v.GenericSchema | undefined, name: string): OptionWords {
  const own = schema !== undefined && "wrapped" in schema ? (schema.wrapped as v.GenericSchema) : undefined;
  const { words } = (own === undefined ? {} : v.getMetadata(own)) as { readonly words?: OptionWords };
  return words ?? { label: name, expected: "another value" };
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

const finiteGrowth = (growth: number): number => Math.min(LIMITS.growth, growth);

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
    maxTetrahedra: MESH_DEFAULTS.maxTetrahedra,
  };
}

/** Converts valid options. */
export function engineInspectionOptions(options: InspectionOptions): EngineInspectionOptions {
  const { innerShells, maxDiagnostics } = v.parse(inspectionSchema, options);
  return { innerShells: INNER_SHELL_NUMBERS[innerShells], maxDiagnostics };
}

/** Converts valid options. */
export function engineCoverOptions(options: CoverOptions): { readonly size: number; readonly shape: number } {
  const { size = 0, shape } = v.parse(coverSchema, options);
  return { size, shape: COVER_SHAPE_NUMBERS[shape] };
}

/** Converts valid options. */
export function engineProposalOptions(options: ProposalOptions): EngineProposalOptions {
  const { maxSize, minSize, anglePerEdge, layers, growth } = v.parse(proposalSchema, options);
  return {
    uniform: maxSize ?? PROPOSAL_DEFAULTS.uniform,
    smallest: minSize ?? PROPOSAL_DEFAULTS.smallest,
    elementsPerCircle: anglePerEdge === 0 ? 0 : 360 / anglePerEdge,
    elementsPerGap: layers,
    growth: finiteGrowth(growth),
  };
}

/** Returns the angle of valid options. */
export function angleOfSplit(options: SplitOptions): number {
  return v.parse(splitSchema, options).angle ?? REMESH_DEFAULTS.featureAngle;
}

/** Converts valid options. */
export function engineImproveOptions(options: ImproveOptions): EngineImproveOptions {
  const { optimization, maxGrowth } = v.parse(improveSchema, options);
  return { optimization: OPTIMIZATION_NUMBERS[optimization], maxGrowth };
}

/** Converts valid options; the engine chooses what is omitted. Poor details are dropped, unless a length is chosen. */
export function engineRemeshOptions(options: RemeshOptions): EngineRemeshOptions {
  const { background: _, ...parsed } = v.parse(remeshSchema, options);
  const chosen = Object.fromEntries(Object.entries(parsed).filter(([, value]) => value !== undefined));
  return {
    ...REMESH_DEFAULTS,
    ...chosen,
    growth: finiteGrowth(parsed.growth),
    dropPoorDetails: parsed.dropDetails === undefined,
    innerShells: INNER_SHELL_NUMBERS[parsed.innerShells],
  };
}

/** Converts valid options. */
export function engineRepairOptions(options: RepairOptions): EngineRepairOptions {
  const { weld, fillHoles, innerShells, ...switches } = v.parse(repairSchema, options);
  return {
    ...switches,
    weldDistance: weld === false ? -1 : weld,
    maxHoleEdges: fillHoles,
    innerShells: INNER_SHELL_NUMBERS[innerShells],
  };
}

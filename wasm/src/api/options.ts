/** Options of the calls: a schema for each options object, with limits and defaults, and the engine's form of it. */
import * as v from "valibot";
import { LIMITS } from "../base/limits.js";
import { asObject, shown } from "../base/values.js";
import { objectWith } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type {
  EngineInspectionOptions,
  EngineOptions,
  EngineProposalOptions,
  EngineRepairOptions,
} from "../engine/loader.js";
import { type BackgroundArrays, checkBackground, hasSourcesOnly } from "../project/background-arrays.js";
import type { Project } from "../project/schema.js";
import type {
  CoverOptions,
  FrontOrder,
  InnerShells,
  InspectionOptions,
  MeshOptions,
  Optimization,
  PreviewOptions,
  ProposalOptions,
  RefineOptions,
  RepairOptions,
} from "./option-types.js";

/** Growth of the element size per unit of distance from a given surface's edges. */
export const DEFAULT_GROWTH = 0.3;
/** Largest ratio of the sizes of neighbouring elements in a background grid. */
export const DEFAULT_GRADATION = 1.3;
export const DEFAULT_INNER_SHELLS: InnerShells = "cavities";
/** The engine's numbers (cpp/include/tetrafront/options.h). */
export const INNER_SHELLS: Readonly<Record<InnerShells, number>> = { cavities: 0, regions: 1 };

/** Number of diagnostics listed per code (cpp/include/tetrafront/surface_tools.h). */
export const DEFAULT_MAX_DIAGNOSTICS = 1000;

export const DEFAULT_ORDER: FrontOrder = "layered";
/** The engine's numbers (cpp/include/tetrafront/options.h). */
export const FRONT_ORDERS: Readonly<Record<FrontOrder, number>> = { layered: 0, "smallest-first": 1 };

export const DEFAULT_FILTERS = true;
/** Number of tetrahedra that the memory permits (cpp/include/tetrafront/options.h). */
const MAX_TETRAHEDRA = 20_000_000;

export const DEFAULT_OPTIMIZATION: Optimization = "default";
/** The engine's numbers (cpp/include/tetrafront/options.h), in the order of effort. */
export const OPTIMIZATIONS: Readonly<Record<Optimization, number>> = {
  none: 0,
  fast: 1,
  default: 2,
  thorough: 3,
};

export type CoverShape = NonNullable<CoverOptions["shape"]>;
export const DEFAULT_COVER_SHAPE: CoverShape = "box";
/** The engine's numbers (cpp/include/tetrafront/covering_grid.h). */
export const COVER_SHAPES: Readonly<Record<CoverShape, number>> = { box: 0, tetrahedron: 1 };

/** Defaults of the engine (cpp/include/tetrafront/size_proposals.h); 0 leaves the choice to the engine. */
export const DEFAULT_PROPOSAL: EngineProposalOptions = {
  uniform: 0,
  smallest: 0,
  elementsPerCircle: 24,
  elementsPerGap: 3,
  growth: 0.3,
};

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

/** Limits of the magnitude of coordinates (cpp/src/geom/coordinates.h); other sizes make no sense. */
const MIN_LENGTH = 1e-30;
const MAX_LENGTH = LIMITS.length;
const within = (min: number, max: number) => v.pipe(v.number(), v.minValue(min), v.maxValue(max));
const wholeWithin = (min: number, max: number) => v.pipe(within(min, max), v.integer());

const sizeOption = (label: string) =>
  option(label, "a size from 1e-30 to 1e30, in model units", within(MIN_LENGTH, MAX_LENGTH), undefined);
const growthOption = (otherwise: number) =>
  option(
    "growth",
    `a growth from 0 to ${LIMITS.growth}, for example ${DEFAULT_GROWTH}`,
    within(0, LIMITS.growth),
    otherwise,
  );
function choiceOption<const Choice extends string>(
  label: string,
  table: Readonly<Record<Choice, number>>,
  otherwise: NoInfer<Choice>,
) {
  const choices = Object.keys(table) as Choice[];
  return option(label, `one of ${choices.join(", ")}`, v.picklist(choices), otherwise);
}
const switchOption = (label: string, otherwise: boolean) =>
  option(label, "true or false", v.boolean(), otherwise);

/** Checked together with the size by `checkBackground`. */
const background = v.optional(v.custom<BackgroundArrays>(() => true));
const innerShells = choiceOption("meaning of inner shells", INNER_SHELLS, DEFAULT_INNER_SHELLS);

const meshEntries = {
  size: sizeOption("element size"),
  background,
  growth: growthOption(DEFAULT_GROWTH),
  gradation: option(
    "gradation",
    `0, or a gradation above 1 and up to ${LIMITS.gradation}, such as ${DEFAULT_GRADATION}`,
    v.pipe(
      within(0, LIMITS.gradation),
      v.check((value) => value === 0 || value > 1),
    ),
    DEFAULT_GRADATION,
  ),
  innerShells,
  order: choiceOption("order of the front", FRONT_ORDERS, DEFAULT_ORDER),
  optimization: choiceOption("optimization", OPTIMIZATIONS, DEFAULT_OPTIMIZATION),
  filters: switchOption("choice of filters", DEFAULT_FILTERS),
  exactFillOnly: switchOption("choice of the exact fill alone", false),
} satisfies EntriesOf<MeshOptions>;
const meshSchema = objectWith(meshEntries);

const refineSchema = objectWith({
  ...meshEntries,
  volume: option(
    "volume",
    "the enclosed volume, as inspectSurface returns it",
    within(0, Number.MAX_VALUE),
    undefined,
  ),
} satisfies EntriesOf<RefineOptions>);

const previewSchema = objectWith({
  size: meshEntries.size,
  innerShells,
  background,
} satisfies EntriesOf<PreviewOptions>);

const inspectionSchema = objectWith({
  innerShells,
  maxDiagnostics: option(
    "number of diagnostics to list",
    `a whole number from 1 to ${LIMITS.maxDiagnostics}`,
    wholeWithin(1, LIMITS.maxDiagnostics),
    DEFAULT_MAX_DIAGNOSTICS,
  ),
} satisfies EntriesOf<InspectionOptions>);

const coverSchema = objectWith({
  size: meshEntries.size,
  shape: choiceOption("shape", COVER_SHAPES, DEFAULT_COVER_SHAPE),
} satisfies EntriesOf<CoverOptions>);

const MAX_PROPOSED = 1000;
const countOption = (label: string, otherwise: number) =>
  option(label, `a number from 0 to ${MAX_PROPOSED}; 0 omits it`, within(0, MAX_PROPOSED), otherwise);
const proposalSchema = objectWith({
  uniform: sizeOption("uniform size"),
  smallest: sizeOption("smallest size"),
  elementsPerCircle: countOption("number of elements per circle", DEFAULT_PROPOSAL.elementsPerCircle),
  elementsPerGap: countOption("number of elements per gap", DEFAULT_PROPOSAL.elementsPerGap),
  growth: growthOption(DEFAULT_PROPOSAL.growth),
} satisfies EntriesOf<ProposalOptions>);

/** The engine's limit (cpp/include/tetrafront/surface_tools.h): the work grows with its cube. */
const MAX_HOLE_EDGES = 200;
const repairSchema = objectWith({
  innerShells,
  weld: option(
    "weld distance",
    "a distance from 0 to 1e30, in model units",
    v.union([v.literal(false), within(0, MAX_LENGTH)]),
    0,
  ),
  removeTriangles: switchOption("choice of removing triangles", true),
  fillHoles: option(
    "number of edges of holes to fill",
    `a whole number from 0 to ${MAX_HOLE_EDGES}`,
    wholeWithin(0, MAX_HOLE_EDGES),
    0,
  ),
  orient: switchOption("choice of orienting triangles", true),
} satisfies EntriesOf<RepairOptions>);

const gridSchema = objectWith({ sizes: v.optional(v.unknown()) });

export function checkOptions(options: MeshOptions): Diagnostic[] {
  return checkWithBackground(options, meshSchema);
}

/** Checks the options of `refineSurface`, which needs sizes. */
export function checkRefineOptions(options: RefineOptions): Diagnostic[] {
  const wrong = checkWithBackground(options, refineSchema);
  if (wrong.length > 0 || options.size !== undefined || options.background !== undefined) return wrong;
  const message = "there are no sizes to refine the surface by";
  return [invalidOption("size", message, "Pass an element size, sources of size or a background grid.")];
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

function checkWithBackground(
  options: Pick<MeshOptions, "size" | "background">,
  schema: OptionsSchema,
): Diagnostic[] {
  const wrong = checkAgainst(options, schema);
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
function checkAgainst(options: unknown, schema: OptionsSchema): Diagnostic[] {
  const parsed = v.safeParse(schema, options, { abortPipeEarly: true });
  if (parsed.success) return [];
  return parsed.issues.map(({ path, input, expected }) => {
    const name = path?.[0].key;
    if (typeof name !== "string") {
      return invalidOption("options", `the options are ${shown(input)}`, "Pass an object, or omit them.");
    }
    const known = Object.keys(schema.entries);
    if (expected === "never" && !known.includes(name)) {
      const remedy = `Correct its name: the options are ${known.join(", ")}.`;
      return invalidOption(name, `there is no option "${name}"`, remedy);
    }
    const { label, expected: wanted } = wordsOf(schema.entries[name], name);
    return invalidOption(name, `the ${label} is ${shown(input)}`, `Use ${wanted}.`);
  });
}

function wordsOf(schema: v.GenericSchema | undefined, name: string): OptionWords {
  const own = schema !== undefined && "wrapped" in schema ? (schema.wrapped as v.GenericSchema) : undefined;
  const { words } = (own === undefined ? {} : v.getMetadata(own)) as { readonly words?: OptionWords };
  return words ?? { label: name, expected: "another value" };
}

/**
 * Adds the project's own settings to options that the caller omits. A background grid of the caller also replaces
 * the project's uniform size.
 */
export function withSettings(options: MeshOptions, { meshing }: Project): MeshOptions {
  if (meshing === undefined) return options;
  const given = Object.entries(options).filter(([, value]) => value !== undefined);
  const { background } = options;
  const keepsSize = background === undefined || hasSourcesOnly(background);
  const settings = keepsSize ? meshing : { ...meshing, size: undefined };
  return { ...settings, ...Object.fromEntries(given) };
}

/** Converts valid options; a size of 0 means none. */
export function engineOptions(options: MeshOptions): EngineOptions {
  const { size = 0, growth, gradation, filters, exactFillOnly, ...choices } = v.parse(meshSchema, options);
  return {
    size,
    growth,
    gradation,
    innerShells: INNER_SHELLS[choices.innerShells],
    order: FRONT_ORDERS[choices.order],
    filters,
    optimization: OPTIMIZATIONS[choices.optimization],
    maxTetrahedra: MAX_TETRAHEDRA,
    exactFillOnly,
  };
}

/** Converts valid options. */
export function engineInspectionOptions(options: InspectionOptions): EngineInspectionOptions {
  const { innerShells, maxDiagnostics } = v.parse(inspectionSchema, options);
  return { innerShells: INNER_SHELLS[innerShells], maxDiagnostics };
}

/** Converts valid options. */
export function engineCoverOptions(options: CoverOptions): { readonly size: number; readonly shape: number } {
  const { size = 0, shape } = v.parse(coverSchema, options);
  return { size, shape: COVER_SHAPES[shape] };
}

/** Converts valid options. */
export function engineProposalOptions(options: ProposalOptions): EngineProposalOptions {
  const { uniform = 0, smallest = 0, ...rest } = v.parse(proposalSchema, options);
  return { uniform, smallest, ...rest };
}

/** Converts valid options. */
export function engineRepairOptions(options: RepairOptions): EngineRepairOptions {
  const { weld, removeTriangles, fillHoles, orient, innerShells } = v.parse(repairSchema, options);
  return {
    weldDistance: weld === false ? -1 : weld,
    removeTriangles,
    maxHoleEdges: fillHoles,
    orient,
    innerShells: INNER_SHELLS[innerShells],
  };
}

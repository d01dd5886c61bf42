/** The options as the engine takes them, or what is wrong with them. */
import { LIMITS } from "../base/limits.js";
import { asObject, shown } from "../base/values.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type {
  EngineInspectionOptions,
  EngineOptions,
  EngineProposalOptions,
  EngineRepairOptions,
} from "../engine/protocol.js";
import { checkBackground, hasSourcesOnly } from "../project/background-arrays.js";
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
/** The most by which sizes grow from one element to the next. */
export const DEFAULT_GRADATION = 1.3;
export const DEFAULT_INNER_SHELLS: InnerShells = "cavities";
/** The engine's numbers (cpp/include/tetrafront/options.h). */
export const INNER_SHELLS: Readonly<Record<InnerShells, number>> = { cavities: 0, regions: 1 };

/** Of each code (cpp/include/tetrafront/surface_tools.h). */
export const DEFAULT_MAX_DIAGNOSTICS = 1000;

export const DEFAULT_ORDER: FrontOrder = "layered";
/** The engine's numbers (cpp/include/tetrafront/options.h). */
export const FRONT_ORDERS: Readonly<Record<FrontOrder, number>> = { layered: 0, "smallest-first": 1 };

export const DEFAULT_FILTERS = true;

export const DEFAULT_OPTIMIZATION: Optimization = "default";
/** The engine's numbers, in the order of effort. */
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

/** As the engine has them (cpp/include/tetrafront/size_proposals.h); 0 leaves the choice to it. */
export const DEFAULT_PROPOSAL: EngineProposalOptions = {
  uniform: 0,
  smallest: 0,
  elementsPerCircle: 24,
  elementsPerGap: 3,
  growth: 0.3,
};

/** What an option may be: undefined where it is fine, else what to give instead. */
type Rule = (value: unknown) => string | undefined;
type Rules<Options> = { readonly [Name in keyof Options]-?: readonly [words: string, rule: Rule] };

const isFiniteNumber = (value: unknown): value is number =>
  typeof value === "number" && Number.isFinite(value);
const isWholeNumber = (value: unknown, least: number, most: number): boolean =>
  Number.isInteger(value) && Number(value) >= least && Number(value) <= most;
/** What coordinates may be (cpp/src/geom/coordinates.h); sizes beyond are no sizes of anything. */
const SMALLEST = 1e-30;
const LARGEST = LIMITS.length;
const within =
  (least: number, most: number, what: string): Rule =>
  (value) =>
    isFiniteNumber(value) && value >= least && value <= most ? undefined : what;
const length = within(SMALLEST, LARGEST, "a size from 1e-30 to 1e30, in model units");
const oneOf =
  (table: object): Rule =>
  (value) =>
    typeof value === "string" && Object.hasOwn(table, value)
      ? undefined
      : `one of ${Object.keys(table).join(", ")}`;
const trueOrFalse: Rule = (value) => (typeof value === "boolean" ? undefined : "true or false");
const growth = within(0, LIMITS.growth, `a growth from 0 to ${LIMITS.growth}, for example ${DEFAULT_GROWTH}`);

const MESH_RULES: Rules<Omit<MeshOptions, "background">> = {
  size: ["element size", length],
  growth: ["growth", growth],
  gradation: [
    "gradation",
    (value) =>
      isFiniteNumber(value) && (value === 0 || (value > 1 && value <= LIMITS.gradation))
        ? undefined
        : `0, or a gradation above 1 and up to ${LIMITS.gradation}, such as ${DEFAULT_GRADATION}`,
  ],
  innerShells: ["meaning of inner shells", oneOf(INNER_SHELLS)],
  order: ["order of the front", oneOf(FRONT_ORDERS)],
  optimization: ["optimization", oneOf(OPTIMIZATIONS)],
  filters: ["choice of filters", trueOrFalse],
  exactFillOnly: ["choice of the exact fill alone", trueOrFalse],
};

const REFINE_RULES: Rules<Omit<RefineOptions, "background">> = {
  ...MESH_RULES,
  volume: [
    "volume",
    (value) =>
      isFiniteNumber(value) && value >= 0 ? undefined : "the enclosed volume, as inspectSurface tells it",
  ],
};

const PREVIEW_RULES: Rules<Omit<PreviewOptions, "background">> = {
  size: MESH_RULES.size,
  innerShells: MESH_RULES.innerShells,
};

const INSPECTION_RULES: Rules<InspectionOptions> = {
  innerShells: MESH_RULES.innerShells,
  maxDiagnostics: [
    "number of findings to list",
    (value) =>
      isWholeNumber(value, 1, LIMITS.maxDiagnostics)
        ? undefined
        : `a whole number from 1 to ${LIMITS.maxDiagnostics}`,
  ],
};

const COVER_RULES: Rules<CoverOptions> = {
  size: MESH_RULES.size,
  shape: ["shape", oneOf(COVER_SHAPES)],
};

const MOST_PROPOSED = 1000;
const count = within(0, MOST_PROPOSED, `a number from 0 to ${MOST_PROPOSED}; 0 leaves it out`);
const PROPOSAL_RULES: Rules<ProposalOptions> = {
  uniform: ["uniform size", length],
  smallest: ["smallest size", length],
  elementsPerCircle: ["number of elements per circle", count],
  elementsPerGap: ["number of elements per gap", count],
  growth: ["growth", growth],
};

/** As the engine has it (cpp/include/tetrafront/surface_tools.h): the work grows with its cube. */
const MOST_HOLE_EDGES = 200;
const REPAIR_RULES: Rules<RepairOptions> = {
  innerShells: MESH_RULES.innerShells,
  weld: [
    "weld distance",
    (value) =>
      value === false || (isFiniteNumber(value) && value >= 0 && value <= LARGEST)
        ? undefined
        : "a distance from 0 to 1e30, in model units",
  ],
  removeTriangles: ["choice of removing triangles", trueOrFalse],
  fillHoles: [
    "number of edges of holes to fill",
    (value) =>
      isWholeNumber(value, 0, MOST_HOLE_EDGES) ? undefined : `a whole number from 0 to ${MOST_HOLE_EDGES}`,
  ],
  orient: ["choice of orienting triangles", trueOrFalse],
};

/** What is wrong with the options; empty where nothing is. */
export function checkOptions(options: MeshOptions): Diagnostic[] {
  return checkWithBackground(options, MESH_RULES);
}

function checkWithBackground<Options extends PreviewOptions>(
  options: Options,
  rules: Rules<Omit<Options, "background">>,
): Diagnostic[] {
  const { background, ...rest } = asObject(options) as Options;
  const wrong = checkAgainst(options, rest, rules, ["background"]);
  if (background === undefined) return wrong;
  if (rest.size !== undefined && !hasSourcesOnly(background)) {
    const message = "both an element size and a background grid are given";
    wrong.push(invalidOption("background", message, "Give one of them: one size, or the grid's."));
  }
  return [...wrong, ...checkBackground(background)];
}

/** Of `refineSurface`, which needs something to go by. */
export function checkRefineOptions(options: RefineOptions): Diagnostic[] {
  const wrong = checkWithBackground(options, REFINE_RULES);
  if (wrong.length > 0 || options.size !== undefined || options.background !== undefined) return wrong;
  const message = "no sizes are given to refine the surface by";
  return [invalidOption("size", message, "Give an element size, sources of size or a background grid.")];
}

export function checkPreviewOptions(options: PreviewOptions): Diagnostic[] {
  return checkWithBackground(options, PREVIEW_RULES);
}

export function checkInspectionOptions(options: InspectionOptions): Diagnostic[] {
  return checkAgainst(options, options, INSPECTION_RULES);
}

export function checkCoverOptions(options: CoverOptions): Diagnostic[] {
  return checkAgainst(options, options, COVER_RULES);
}

/** Of `backgroundFromMesh`; the sizes are looked at together with the mesh. */
export function checkGridOptions(options: { readonly sizes?: unknown }): Diagnostic[] {
  return checkAgainst(options, options, { sizes: ["sizes", () => undefined] });
}

export function checkProposalOptions(options: ProposalOptions): Diagnostic[] {
  return checkAgainst(options, options, PROPOSAL_RULES);
}

/**
 * The options with the project's own settings where the caller gives none. A background grid of the
 * caller takes the place of the project's one size, too.
 */
export function withSettings(options: MeshOptions, { meshing }: Project): MeshOptions {
  if (meshing === undefined) return options;
  const given = Object.entries(options).filter(([, value]) => value !== undefined);
  const { background } = options;
  const keepsSize = background === undefined || hasSourcesOnly(background);
  const settings = keepsSize ? meshing : { ...meshing, size: undefined };
  return { ...settings, ...Object.fromEntries(given) };
}

export function checkRepairOptions(options: RepairOptions): Diagnostic[] {
  return checkAgainst(options, options, REPAIR_RULES);
}

function checkAgainst<Options>(
  given: unknown,
  values: Options,
  rules: Rules<Options>,
  alsoKnown: readonly string[] = [],
): Diagnostic[] {
  if (typeof given !== "object" || given === null) {
    return [
      invalidOption("options", `the options are ${shown(given)}`, "Give an object, or leave them out."),
    ];
  }
  const wrong: Diagnostic[] = [];
  for (const [name, value] of Object.entries(values as object)) {
    if (!Object.hasOwn(rules, name)) {
      const known = [...Object.keys(rules), ...alsoKnown].join(", ");
      wrong.push(
        invalidOption(name, `there is no option "${name}"`, `Correct its name: the options are ${known}.`),
      );
    } else if (value !== undefined) {
      const [words, rule] = rules[name as keyof Options];
      const wanted = rule(value);
      if (wanted !== undefined)
        wrong.push(invalidOption(name, `the ${words} is ${shown(value)}`, `Give ${wanted}.`));
    }
  }
  return wrong;
}

/** Options that passed the check; a size of 0 stands for none. */
export function engineOptions(options: MeshOptions): EngineOptions {
  const {
    size = 0,
    growth = DEFAULT_GROWTH,
    gradation = DEFAULT_GRADATION,
    innerShells = DEFAULT_INNER_SHELLS,
    order = DEFAULT_ORDER,
    filters = DEFAULT_FILTERS,
    optimization = DEFAULT_OPTIMIZATION,
    exactFillOnly = false,
  } = options;
  return {
    size,
    growth,
    gradation,
    innerShells: INNER_SHELLS[innerShells],
    order: FRONT_ORDERS[order],
    filters,
    optimization: OPTIMIZATIONS[optimization],
    exactFillOnly,
  };
}

/** Options that passed the check. */
export function engineInspectionOptions(options: InspectionOptions): EngineInspectionOptions {
  const { innerShells = DEFAULT_INNER_SHELLS, maxDiagnostics = DEFAULT_MAX_DIAGNOSTICS } = options;
  return { innerShells: INNER_SHELLS[innerShells], maxDiagnostics };
}

/** Options that passed the check. */
export function engineProposalOptions(options: ProposalOptions): EngineProposalOptions {
  const given = Object.entries(options).filter(([, value]) => value !== undefined);
  return { ...DEFAULT_PROPOSAL, ...(Object.fromEntries(given) as Partial<EngineProposalOptions>) };
}

/** Options that passed the check. */
export function engineRepairOptions(options: RepairOptions): EngineRepairOptions {
  const { weld = 0, removeTriangles = true, fillHoles = 0, orient = true } = options;
  const { innerShells = DEFAULT_INNER_SHELLS } = options;
  return {
    weldDistance: weld === false ? -1 : weld,
    removeTriangles,
    maxHoleEdges: fillHoles,
    orient,
    innerShells: INNER_SHELLS[innerShells],
  };
}

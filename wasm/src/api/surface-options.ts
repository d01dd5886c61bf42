/** Options of the calls about given surfaces: schemas, checks, and the engine's form. */
import * as v from "valibot";
import { LIMITS, limitText } from "../base/limits.js";
import { index, objectWith } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { EngineInspectionOptions, EngineRemeshOptions, EngineRepairOptions } from "../engine/loader.js";
import {
  INSPECTION_DEFAULTS,
  MAX_HOLE_EDGES,
  MAX_LAYERS,
  MAX_LENGTH,
  MAX_SIZE_FACTOR,
  MIN_LENGTH,
  MIN_SIZE_FACTOR,
  REMESH_DEFAULTS,
  REPAIR_DEFAULTS,
} from "../generated/constants.js";
import { hasSourcesOnly } from "../project/background-arrays.js";
import {
  option,
  type EntriesOf,
  within,
  wholeWithin,
  growthOption,
  switchOption,
  distanceOption,
  angleOption,
  shared,
  checkAgainst,
  checkWithBackground,
  finiteGrowth,
  INNER_SHELL_NUMBERS,
} from "./option-schema.js";
import type {
  InspectionOptions,
  RemeshOptions,
  RepairOptions,
  SplitOptions,
  SurfaceProposalOptions,
} from "./option-types.js";

const remeshEntries = {
  size: shared.size,
  minSize: shared.minSize,
  maxSize: shared.maxSize,
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
  maxVolume: shared.maxVolume,
  innerShells: shared.innerShells,
  background: shared.background,
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

const inspectionSchema = objectWith({
  innerShells: shared.innerShells,
  maxDiagnostics: option(
    "number of diagnostics to list",
    `a whole number from 1 to ${LIMITS.maxDiagnostics}`,
    wholeWithin(1, LIMITS.maxDiagnostics),
    INSPECTION_DEFAULTS.maxDiagnostics,
  ),
} satisfies EntriesOf<InspectionOptions>);

const repairSchema = objectWith({
  innerShells: shared.innerShells,
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

export function checkInspectionOptions(options: InspectionOptions): Diagnostic[] {
  return checkAgainst(options, inspectionSchema);
}

export function checkRepairOptions(options: RepairOptions): Diagnostic[] {
  return checkAgainst(options, repairSchema);
}

/** Converts valid options. */
export function engineInspectionOptions(options: InspectionOptions): EngineInspectionOptions {
  const { innerShells, maxDiagnostics } = v.parse(inspectionSchema, options);
  return { innerShells: INNER_SHELL_NUMBERS[innerShells], maxDiagnostics };
}

/** Returns the angle of valid options. */
export function angleOfSplit(options: SplitOptions): number {
  return v.parse(splitSchema, options).angle ?? REMESH_DEFAULTS.featureAngle;
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

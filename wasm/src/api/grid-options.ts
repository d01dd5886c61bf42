/** Options of the calls that make background grids and sources: schemas, checks, and the engine's form. */
import * as v from "valibot";
import { numbersOf } from "../base/enums.js";
import { objectWith } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { EngineProposalOptions } from "../engine/loader.js";
import {
  COVER_SHAPES,
  type CoverShape,
  MAX_SHADED_CELLS,
  PROPOSAL_DEFAULTS,
  SHADED_CELLS,
} from "../generated/constants.js";
import {
  option,
  type EntriesOf,
  within,
  wholeWithin,
  growthOption,
  choiceOption,
  shared,
  checkAgainst,
  finiteGrowth,
} from "./option-schema.js";
import type { CoverOptions, CurvatureOptions, ProposalOptions } from "./option-types.js";

const COVER_SHAPE_NUMBERS = numbersOf(COVER_SHAPES);
export const DEFAULT_COVER_SHAPE: CoverShape = "box";

const coverSchema = objectWith({
  size: shared.size,
  shape: choiceOption("shape", COVER_SHAPES, DEFAULT_COVER_SHAPE),
} satisfies EntriesOf<CoverOptions>);

/** Largest number of elements around a circle, and across a gap, in a proposal. */
const MAX_PROPOSED = 1000;

const proposalSchema = objectWith({
  maxSize: shared.maxSize,
  minSize: shared.minSize,
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

const curvatureSchema = objectWith({
  cells: option(
    "number of cells",
    `a whole number from 1 to ${MAX_SHADED_CELLS}`,
    wholeWithin(1, MAX_SHADED_CELLS),
    SHADED_CELLS,
  ),
} satisfies EntriesOf<CurvatureOptions>);

const gridSchema = objectWith({ sizes: v.optional(v.unknown()) });

export function checkCoverOptions(options: CoverOptions): Diagnostic[] {
  return checkAgainst(options, coverSchema);
}

export function checkCurvatureOptions(options: CurvatureOptions): Diagnostic[] {
  return checkAgainst(options, curvatureSchema);
}

/** Checks the options of `backgroundFromMesh`; the sizes are checked together with the mesh. */
export function checkGridOptions(options: { readonly sizes?: unknown }): Diagnostic[] {
  return checkAgainst(options, gridSchema);
}

export function checkProposalOptions(options: ProposalOptions): Diagnostic[] {
  return checkAgainst(options, proposalSchema);
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

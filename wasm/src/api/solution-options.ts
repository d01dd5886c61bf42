/** Options of `sizeFromSolution` and `transferSolution`: types, schemas, and the engine's form. */
import * as v from "valibot";
import { numbersOf } from "../base/enums.js";
import { objectWith } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { EngineSolutionOptions } from "../engine/loader.js";
import { ERROR_NORMS, type ErrorNorm, SOLUTION_SIZE_DEFAULTS } from "../generated/constants.js";
import {
  checkAgainst,
  choiceOption,
  type EntriesOf,
  growthOption,
  option,
  shared,
  switchOption,
  within,
} from "./option-schema.js";
import type { SolutionSizeOptions, TransferOptions } from "./option-types.js";

const NORM_NUMBERS = numbersOf(ERROR_NORMS);
export const DEFAULT_NORM: ErrorNorm = "l2";
/** Largest ratio of two sizes at a node that the options permit. */
export const MAX_ASPECT = 1e6;
const MAX_ELEMENTS = 1e9;
const MIN_ORDER = 0.1;
const MAX_ORDER = 20;
/** The engine's word for no limit is 0, so a growth of 0 is a tiny one. */
const LEAST_GROWTH = 1e-9;

const sizeSchema = objectWith({
  elements: option(
    "number of elements",
    `a number from 1 to ${MAX_ELEMENTS}`,
    within(1, MAX_ELEMENTS),
    undefined,
  ),
  error: option(
    "error",
    "a number above 0, in the unit of the field and the norm",
    v.pipe(v.number(), v.gtValue(0), v.finite()),
    undefined,
  ),
  norm: choiceOption("norm", ERROR_NORMS, DEFAULT_NORM),
  isotropic: switchOption("choice of isotropic sizes", SOLUTION_SIZE_DEFAULTS.isIsotropic),
  minSize: shared.minSize,
  maxSize: shared.maxSize,
  maxAspect: option(
    "largest aspect",
    `a ratio from 1 to ${MAX_ASPECT}`,
    within(1, MAX_ASPECT),
    SOLUTION_SIZE_DEFAULTS.maxAspect,
  ),
  growth: growthOption(SOLUTION_SIZE_DEFAULTS.growth),
  indicator: option("indicator", "the name of a field", v.string(), undefined),
  indicatorOrder: option(
    "order of the indicator",
    `a number from ${MIN_ORDER} to ${MAX_ORDER}`,
    within(MIN_ORDER, MAX_ORDER),
    undefined,
  ),
} satisfies EntriesOf<SolutionSizeOptions>);

const transferSchema = objectWith({
  conservative: switchOption("choice of conservation", false),
} satisfies EntriesOf<TransferOptions>);

export function checkSolutionSizeOptions(options: SolutionSizeOptions): Diagnostic[] {
  const wrong = checkAgainst(options, sizeSchema);
  if (wrong.length > 0) return wrong;
  const { elements, error, minSize = 0, maxSize = Infinity } = options;
  if ((elements === undefined) === (error === undefined)) {
    const message =
      elements === undefined
        ? "neither a number of elements nor an error is given"
        : "both a number of elements and an error are given";
    wrong.push(invalidOption("elements", message, "Set one of them: elements, or error."));
  }
  if (minSize > maxSize) {
    const message = `the smallest size is ${minSize}, but the largest is ${maxSize}`;
    wrong.push(invalidOption("minSize", message, "Use a smallest size that is at most the largest."));
  }
  if (options.indicatorOrder !== undefined && options.indicator === undefined) {
    const remedy = "Set indicator, or omit the order.";
    wrong.push(invalidOption("indicatorOrder", "an order is given, but no indicator", remedy));
  }
  return wrong;
}

export function checkTransferOptions(options: TransferOptions): Diagnostic[] {
  return checkAgainst(options, transferSchema);
}

/** Converts valid options. `indicator`: the index of its field, if there is one. */
export function engineSolutionOptions(
  options: SolutionSizeOptions,
  indicator: number = SOLUTION_SIZE_DEFAULTS.indicator,
): EngineSolutionOptions {
  const { norm, isotropic, growth, ...sizes } = v.parse(sizeSchema, options);
  const { elements = 0, error = 0, minSize = 0, maxSize = 0, maxAspect } = sizes;
  const { indicatorOrder = SOLUTION_SIZE_DEFAULTS.indicatorOrder } = sizes;
  return {
    norm: NORM_NUMBERS[norm],
    elements,
    error,
    isIsotropic: isotropic,
    minSize,
    maxSize,
    maxAspect,
    growth: growth === Infinity ? 0 : Math.max(growth, LEAST_GROWTH),
    indicator,
    indicatorOrder,
  };
}

/** The options as the engine takes them, or what is wrong with them. */
import { packageDiagnostic } from "./diagnostics.js";
import type { EngineOptions } from "./protocol.js";
import type { Diagnostic, FrontOrder, MeshOptions, Optimization } from "./types.js";

/** Growth of the element size per unit of distance from a given surface's edges. */
export const DEFAULT_GROWTH = 0.3;
/** The most by which sizes grow from one element to the next. */
export const DEFAULT_GRADATION = 1.3;
export const DEFAULT_ORDER: FrontOrder = "layered";
/** The engine's numbers (cpp/include/tetrafront/options.h). */
export const FRONT_ORDERS: Readonly<Record<FrontOrder, number>> = { layered: 0, "smallest-first": 1 };

export const DEFAULT_OPTIMIZATION: Optimization = "default";
/** The engine's numbers, in the order of effort. */
export const OPTIMIZATIONS: Readonly<Record<Optimization, number>> = {
  none: 0,
  fast: 1,
  default: 2,
  strive: 3,
};

/** What is wrong with the options; empty where nothing is. */
export function checkOptions(options: MeshOptions): Diagnostic[] {
  const {
    size,
    growth = DEFAULT_GROWTH,
    gradation = DEFAULT_GRADATION,
    order = DEFAULT_ORDER,
    optimization = DEFAULT_OPTIMIZATION,
  } = options;
  const wrong: Diagnostic[] = [];
  if (size !== undefined && !(Number.isFinite(size) && size > 0)) {
    wrong.push(invalidOption(`the element size is ${size}`, "Give a finite size above 0, in model units."));
  }
  if (!(Number.isFinite(growth) && growth >= 0)) {
    wrong.push(
      invalidOption(`the growth is ${growth}`, "Give a finite growth of 0 or more, for example 0.3."),
    );
  }
  if (!(Number.isFinite(gradation) && (gradation === 0 || gradation > 1))) {
    wrong.push(
      invalidOption(`the gradation is ${gradation}`, "Give 0, or a finite gradation above 1, such as 1.3."),
    );
  }
  if (!Object.hasOwn(FRONT_ORDERS, order)) {
    const known = Object.keys(FRONT_ORDERS).join(" or ");
    wrong.push(invalidOption(`the order of the front is "${order}"`, `Give ${known}.`));
  }
  if (!Object.hasOwn(OPTIMIZATIONS, optimization)) {
    const known = Object.keys(OPTIMIZATIONS).join(", ");
    wrong.push(invalidOption(`the optimization is "${optimization}"`, `Give one of ${known}.`));
  }
  return wrong;
}

function invalidOption(message: string, remedy: string): Diagnostic {
  return packageDiagnostic("invalid-option", message, remedy);
}

/** Options that passed the check; a size of 0 stands for none. */
export function engineOptions(options: MeshOptions): EngineOptions {
  const {
    size = 0,
    growth = DEFAULT_GROWTH,
    gradation = DEFAULT_GRADATION,
    order = DEFAULT_ORDER,
    optimization = DEFAULT_OPTIMIZATION,
  } = options;
  return { size, growth, gradation, order: FRONT_ORDERS[order], optimization: OPTIMIZATIONS[optimization] };
}

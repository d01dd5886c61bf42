/** The values of named parameters whose expressions may use each other. */
import { namesIn, readNumber, unitKey, type NamedNumbers } from "./expression";

/** A named number. */
export interface Parameter {
  readonly name: string;
  readonly expression: string;
}

/** The values of units, by name. */
export type UnitValues = ReadonlyMap<string, number>;

/** By units and parameters. */
const known = new WeakMap<UnitValues, WeakMap<readonly Parameter[], NamedNumbers>>();
const noParameters: readonly Parameter[] = [];
const noUnits: UnitValues = new Map();

/**
 * Returns the values of all parameters that have one, and those of units. A parameter has none if its expression is invalid,
 * or uses a parameter without a value or, directly or indirectly, itself. The same list and units give the same object.
 */
export function parameterValues(
  parameters: readonly Parameter[] = noParameters,
  units: UnitValues = noUnits,
): NamedNumbers {
  const inUnits = known.get(units) ?? new WeakMap<readonly Parameter[], NamedNumbers>();
  known.set(units, inUnits);
  let values = inUnits.get(parameters);
  if (!values) inUnits.set(parameters, (values = evaluated(parameters, units)));
  return values;
}

function evaluated(parameters: readonly Parameter[], units: UnitValues): NamedNumbers {
  const expressions = new Map(parameters.map(({ name, expression }) => [name, expression]));
  const values = new Map([...units].map(([unit, value]) => [unitKey(unit), value]));
  const visited = new Set<string>();
  // Not by recursion: a chain of parameters may be longer than the stack is deep.
  const stack: { readonly name: string; readonly expression: string; readonly uses: Iterator<string> }[] = [];
  const enter = (name: string): void => {
    const expression = expressions.get(name);
    if (expression === undefined || visited.has(name)) return;
    // A parameter that is reached again before it has a value uses itself, and then gets none.
    visited.add(name);
    stack.push({ name, expression, uses: namesIn(expression).values() });
  };
  for (const { name } of parameters) {
    enter(name);
    for (let top = stack.at(-1); top; top = stack.at(-1)) {
      const used = top.uses.next();
      if (used.done !== true) {
        enter(used.value);
        continue;
      }
      stack.pop();
      const value = readNumber(top.expression, values);
      if (value !== null) values.set(top.name, value);
    }
  }
  return values;
}

/** Returns the names of the parameters whose expressions use a parameter, directly or indirectly, and its own name. */
export function dependentParameters(parameters: readonly Parameter[], name: string): ReadonlySet<string> {
  const found = new Set([name]);
  for (let before = 0; before < found.size;) {
    before = found.size;
    for (const parameter of parameters) {
      if ([...namesIn(parameter.expression)].some((used) => found.has(used))) found.add(parameter.name);
    }
  }
  return found;
}

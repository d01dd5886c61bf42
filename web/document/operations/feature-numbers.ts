import type { Project, ProjectExpression, SolidFeature } from "tetrafront/project";
import { quantity, type Formula, type Quantity } from "../../expressions/quantity";
import { expressionFrom, withKept, type KeptExpression } from "../expression-edits";
import { isTooLong } from "../quantity-positions";
import type { FieldExpressions } from "./operation";

/** Plain data in which numbers may have been typed as expressions. */
export type Typed<Value> = Value extends number
  ? Quantity
  : Value extends object
    ? { readonly [Key in keyof Value]: Typed<Value[Key]> }
    : Value;

const isFormula = (value: object): value is Formula => "form" in value && "text" in value;

/** Returns plain data with the expressions of its numbers, by their paths of fields: `size.0`. */
export function typed<Value>(value: Value, expressions: FieldExpressions): Typed<Value> {
  return mapped(value, "", (part, path) =>
    typeof part === "number" ? quantity(part, expressions[path]) : undefined,
  ) as Typed<Value>;
}

/** Returns the numbers without expressions. */
export function plain<Value>(value: Typed<Value>): Value {
  return mapped(value, "", (part) =>
    typeof part === "object" && part !== null && isFormula(part) ? part.value : undefined,
  ) as Value;
}

/** Returns the expressions of numbers, by their paths of fields. */
export function expressionsIn(value: unknown): FieldExpressions {
  const found: Record<string, string> = {};
  mapped(value, "", (part, path) => {
    if (typeof part !== "object" || part === null || !isFormula(part)) return undefined;
    found[path] = part.text;
    return part.value;
  });
  return found;
}

/** Returns a copy of plain data. Parts for which the function returns a value are replaced by it. */
function mapped(value: unknown, path: string, replace: (part: unknown, path: string) => unknown): unknown {
  const replaced = replace(value, path);
  if (replaced !== undefined) return replaced;
  if (typeof value !== "object" || value === null) return value;
  const within = (part: unknown, key: string | number): unknown => {
    // Features in a list are found by their ids.
    const own = typeof part === "object" && part !== null && "id" in part ? Number(part.id) : key;
    return mapped(part, path === "" ? String(own) : `${path}.${own}`, replace);
  };
  if (Array.isArray(value)) return value.map(within);
  return Object.fromEntries(Object.entries(value).map(([key, part]) => [key, within(part, key)]));
}

const fieldOf = (feature: number, path: string): string => `features.${feature}.${path}`;

/** Returns the expressions of the numbers of a feature, by their paths in it. */
export function expressionsOfFeature(
  { expressions = [] }: Project,
  body: number,
  feature: number,
): FieldExpressions {
  const start = fieldOf(feature, "");
  return Object.fromEntries(
    expressions
      .filter((kept) => kept.kind === "body" && kept.id === body && kept.field.startsWith(start))
      .map(({ field, expression }) => [field.slice(start.length), expression]),
  );
}

/** Returns the expressions of a project after those of a feature have become others, unless one is too long for the file. */
export function withFeatureExpressions(
  project: Project,
  body: number,
  { id }: Pick<SolidFeature, "id">,
  after: FieldExpressions,
): readonly ProjectExpression[] {
  const stored = Object.values(after).some(isTooLong) ? {} : after;
  const paths = Object.keys({ ...expressionsOfFeature(project, body, id), ...stored });
  const kept = paths.map((path): KeptExpression => ({
    path: { kind: "body", id: body, field: fieldOf(id, path) },
    // A calculation with plain numbers needs no expression.
    expression: expressionFrom(stored[path] ?? "0"),
  }));
  return withKept(project.expressions ?? [], kept);
}

import { applied, type FunctionName } from "./expression";

/**
 * Arithmetic of numbers that may have been typed as expressions. The result of a calculation with at least one formula is a
 * formula: its text is the calculation, which can be repeated after a parameter has changed. Plain numbers give plain
 * numbers, as if they were calculated directly.
 */

/** A number with the expression that it was computed from. */
export interface Formula {
  readonly value: number;
  readonly text: string;
  readonly form: Form;
}

/** What the text of a formula consists of on its outermost level: it decides where parentheses are necessary. */
type Form = "sum" | "product" | "atom";

export type Quantity = number | Formula;

/** Numbers of which some may have been typed as expressions. */
export type Quantities<Numbers extends object> = {
  readonly [Key in keyof Numbers]: Numbers[Key] extends number ? Quantity : Numbers[Key];
};

const looseness: readonly Form[] = ["atom", "product", "sum"];

/** Returns a number, or the formula of a number that was typed as an expression. */
export function quantity(value: number, expression?: string | null): Quantity {
  if (expression == null) return value;
  const text = expression.trim();
  const form = /^[\w.]+$/.test(text) ? "atom" : /^-?[\w.]+([*/][\w.]+)*$/.test(text) ? "product" : "sum";
  return { value, text, form };
}

export const valueOf = (a: Quantity): number => (typeof a === "number" ? a : a.value);

/** Returns the text of a formula; null for a plain number. */
export const formulaText = (a: Quantity): string | null => (typeof a === "number" ? null : a.text);

export function plus(a: Quantity, b: Quantity): Quantity {
  if (typeof a === "number" && typeof b === "number") return a + b;
  if (a === 0) return b;
  if (b === 0) return a;
  const [formula, number] = typeof a === "number" ? [b, a] : [a, b];
  const merged =
    typeof formula === "object" && typeof number === "number" ? withConstant(formula, number) : null;
  if (merged) return merged;
  return joined(a, b);
}

/** Returns a sum, with the texts of both. */
function joined(a: Quantity, b: Quantity): Formula {
  const [left, right] = [textOf(a, "sum"), textOf(b, "product")];
  const value = valueOf(a) + valueOf(b);
  return { value, text: right.startsWith("-") ? left + right : `${left}+${right}`, form: "sum" };
}

const trailingConstant = /^(.*[\w.)])\s*([+-])\s*((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)$/;

/**
 * Returns a sum that ends with a number, with another one added to it: many small moves do not make the text longer. Null if
 * the formula is no such sum.
 */
function withConstant({ value, text, form }: Formula, more: number): Quantity | null {
  const [, before = "", sign, digits] = (form === "sum" && trailingConstant.exec(text)) || [];
  // The sign may be that of an exponent, or within parentheses.
  if (digits === undefined || /(?:^|\W)[\d.]+[eE]$/.test(before) || !isBalanced(before)) return null;
  const constant = Number(`${sign}${digits}`) + more;
  const rest = quantity(value + more - constant, before);
  return constant === 0 ? rest : { ...joined(rest, constant), value: value + more };
}

const isBalanced = (text: string): boolean => text.split("(").length === text.split(")").length;

export function negative(a: Quantity): Quantity {
  if (typeof a === "number") return -a;
  const text = textOf(a, "product");
  return { value: -a.value, text: text.startsWith("-") ? text.slice(1) : `-${text}`, form: "product" };
}

export function minus(a: Quantity, b: Quantity): Quantity {
  if (typeof a === "number" && typeof b === "number") return a - b;
  return formulaText(a) === formulaText(b) ? 0 : plus(a, negative(b));
}

export function times(a: Quantity, b: Quantity): Quantity {
  if (typeof a === "number" && typeof b === "number") return a * b;
  // Numbers come first.
  const [first, second] = typeof b === "number" ? [b, a] : [a, b];
  if (first === 0) return 0;
  if (first === 1) return second;
  if (first === -1) return negative(second);
  const text = `${textOf(first, "product")}*${textOf(second, "atom")}`;
  return { value: valueOf(first) * valueOf(second), text, form: "product" };
}

export function over(a: Quantity, b: Quantity): Quantity {
  if (typeof a === "number" && typeof b === "number") return a / b;
  if (a === 0) return 0;
  if (b === 1) return a;
  return {
    value: valueOf(a) / valueOf(b),
    text: `${textOf(a, "product")}/${textOf(b, "atom")}`,
    form: "product",
  };
}

/** Returns a number above 0 to the power of a plain number. */
export function power(a: Quantity, exponent: number): Quantity {
  if (typeof a === "number") return a ** exponent;
  return {
    value: a.value ** exponent,
    text: `${textOf(a, "atom")}^${textOf(exponent, "atom")}`,
    form: "product",
  };
}

/** Applies a function of expressions: angles are in degrees. */
export function call(name: FunctionName, a: Quantity): Quantity {
  if (typeof a === "number") return applied(name, a);
  return { value: applied(name, a.value), text: `${name}(${a.text})`, form: "atom" };
}

/** Returns a text that may replace a name in an expression. */
export const operandText = (a: Quantity): string => textOf(a, "atom");

/** Returns the text of an operand, in parentheses unless it is as tight as required. */
function textOf(a: Quantity, required: Form): string {
  if (typeof a === "number") return a < 0 && required === "atom" ? `(${a})` : String(a);
  return looseness.indexOf(a.form) <= looseness.indexOf(required) ? a.text : `(${a.text})`;
}

/**
 * Conditions of tasks: expressions over the values of figures, such as `A.touched and A.refused == 0`. They are parsed when
 * the site is built and evaluated in the page by a walk over the tree, never by `eval`.
 */

const relations = ["<=", ">=", "==", "!=", "<", ">"] as const;
type Relation = (typeof relations)[number];
type Operator = "+" | "-" | "*" | "/";

/** A value of a figure: `A.size` is `{ figure: "A", name: "size" }`. */
export interface ValueName {
  readonly figure: string;
  readonly name: string;
}

export type Expression =
  | { readonly kind: "number"; readonly value: number }
  | ({ readonly kind: "value" } & ValueName)
  | { readonly kind: "not"; readonly of: Expression }
  | {
      readonly kind: "join" | "relation" | "operation";
      readonly by: "and" | "or" | Relation | Operator;
      readonly left: Expression;
      readonly right: Expression;
    };

/** Reports the word of a condition that does not fit. */
export class ConditionMismatch extends Error {
  /**
   * @param expected What must be there, in words.
   * @param found The word found instead; empty at the end of the text.
   */
  constructor(
    readonly expected: string,
    readonly found: string,
  ) {
    super(`expected ${expected}, found ${found === "" ? "the end" : `"${found}"`}`);
  }
}

/**
 * Returns the expression that a text describes. `and` binds closer than `or`, and `not` closer than both. Throws
 * ConditionMismatch.
 */
export function parseCondition(text: string): Expression {
  const words = text.match(/\d+\.?\d*|\.\d+|[A-Za-z][\w-]*(?:\.[A-Za-z]\w*)?|[<>=!]=|\S/g) ?? [];
  let next = 0;
  const word = (): string => words[next] ?? "";
  const takeOneOf = <T extends string>(choices: readonly T[]): T | undefined => {
    const found = choices.find((choice) => choice === word());
    if (found !== undefined) next++;
    return found;
  };
  const chain = <T extends "and" | "or" | Operator>(
    kind: "join" | "operation",
    choices: readonly T[],
    part: () => Expression,
  ): Expression => {
    let left = part();
    for (let by = takeOneOf(choices); by !== undefined; by = takeOneOf(choices))
      left = { kind, by, left, right: part() };
    return left;
  };
  const either = (): Expression => chain("join", ["or"], both);
  const both = (): Expression => chain("join", ["and"], negated);
  const negated = (): Expression =>
    takeOneOf(["not"]) === undefined ? comparison() : { kind: "not", of: negated() };
  const comparison = (): Expression => {
    const left = sum();
    const by = takeOneOf(relations);
    return by === undefined ? left : { kind: "relation", by, left, right: sum() };
  };
  const sum = (): Expression => chain("operation", ["+", "-"], product);
  const product = (): Expression => chain("operation", ["*", "/"], atom);
  const atom = (): Expression => {
    if (takeOneOf(["("]) !== undefined) {
      const inner = either();
      if (takeOneOf([")"]) === undefined) throw new ConditionMismatch('")"', word());
      return inner;
    }
    if (takeOneOf(["-"]) !== undefined)
      return { kind: "operation", by: "-", left: { kind: "number", value: 0 }, right: atom() };
    const text = word();
    if (/^[\d.]/.test(text) && Number.isFinite(Number(text))) {
      next++;
      return { kind: "number", value: Number(text) };
    }
    const [figure = "", name] = text.split(".");
    if (name === undefined || figure === "")
      throw new ConditionMismatch("a number or a value such as A.size", text);
    next++;
    return { kind: "value", figure, name };
  };
  const whole = either();
  if (word() !== "") throw new ConditionMismatch("and, or, or the end", word());
  return whole;
}

/** Returns the values that an expression depends on, each as often as it is used. */
export function valuesIn(expression: Expression): readonly ValueName[] {
  switch (expression.kind) {
    case "number":
      return [];
    case "value":
      return [{ figure: expression.figure, name: expression.name }];
    case "not":
      return valuesIn(expression.of);
    default:
      return [...valuesIn(expression.left), ...valuesIn(expression.right)];
  }
}

/** Returns the number of an expression: 1 for true and 0 for false. `valueOf` returns NaN for a value that is not known yet. */
export function evaluate(expression: Expression, valueOf: (name: ValueName) => number): number {
  switch (expression.kind) {
    case "number":
      return expression.value;
    case "value":
      return valueOf(expression);
    case "not":
      return evaluate(expression.of, valueOf) === 0 ? 1 : 0;
    default:
      return combine(expression.by, evaluate(expression.left, valueOf), evaluate(expression.right, valueOf));
  }
}

function combine(by: "and" | "or" | Relation | Operator, left: number, right: number): number {
  switch (by) {
    case "+":
      return left + right;
    case "-":
      return left - right;
    case "*":
      return left * right;
    case "/":
      return left / right;
    default:
      return Number(holds(by, left, right));
  }
}

function holds(by: "and" | "or" | Relation, left: number, right: number): boolean {
  const isTrue = (value: number): boolean => value !== 0 && !Number.isNaN(value);
  switch (by) {
    case "and":
      return isTrue(left) && isTrue(right);
    case "or":
      return isTrue(left) || isTrue(right);
    case "<":
      return left < right;
    case ">":
      return left > right;
    case "<=":
      return left <= right;
    case ">=":
      return left >= right;
    case "==":
      return left === right;
    case "!=":
      return left !== right && !Number.isNaN(left) && !Number.isNaN(right);
  }
}

import { LIMITS } from "tetrafront";

/** Named numbers that an expression may use. Those of units have the keys `1 mm`, `1 in` and so on. */
export type NamedNumbers = ReadonlyMap<string, number>;

export const unitKey = (unit: string): string => `1 ${unit}`;

const noNames: NamedNumbers = new Map();

const tokenPattern = /\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|[A-Za-z_][A-Za-z0-9_]*|[-+*/^()]|\S/g;
const namePattern = /^[A-Za-z_]/;

/**
 * Reads a number the way people type it: `0.25`, `1/3`, `2*pi`, `(1+2)/4`, `1e-3`, `-sqrt(2)/2`, `3^2`, `sin(30)`, `2*r`
 * with a number named `r`. Angles are in degrees. Names are case-sensitive; functions and constants are not. A unit after a
 * number or a product multiplies it: `1/2 in`, `2*r mm`, `1 ft + 3 in`.
 * Returns null for anything else, for a text that is too long or nested more than 200 deep, and for results that are not
 * finite.
 */
export function readNumber(text: string, named: NamedNumbers = noNames): number | null {
  const tokens = text.length > LIMITS.expression ? null : text.match(tokenPattern);
  if (!tokens) return null;
  const reader = new ExpressionReader(tokens, named);
  const value = reader.sum();
  return reader.done && value !== null && Number.isFinite(value) ? value : null;
}

/** Returns whether a text is a number without operators, functions or names. */
export const isPlainNumber = (text: string): boolean =>
  /^\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*$/.test(text);

/** Returns the expression with each number of one name replaced by a text. */
export function withNameReplaced(expression: string, name: string, replacement: string): string {
  return expression.replace(tokenPattern, (token: string, offset: number) =>
    token === name && !isCall(expression.slice(offset + token.length)) && !isUnitAt(expression, offset)
      ? replacement
      : token,
  );
}

/** Returns whether the word at an offset is in the place of a unit: a number comes before it. */
const isUnitAt = (expression: string, offset: number): boolean =>
  /[\w.)]\s*$/.test(expression.slice(0, offset));

/** Returns the words of an expression in the place of units. */
export function unitsIn(expression: string): ReadonlySet<string> {
  const words = [...expression.matchAll(tokenPattern)].filter(
    ({ 0: token, index }) => namePattern.test(token) && isUnitAt(expression, index),
  );
  return new Set(words.map(([token]) => token));
}

/** Returns whether the text after a name makes it the name of a function. */
const isCall = (after: string): boolean => /^\s*\(/.test(after);

/** Returns the names of the numbers that an expression uses, functions and constants excluded. */
export function namesIn(expression: string): ReadonlySet<string> {
  const names = [...expression.matchAll(tokenPattern)].filter(
    ({ 0: token, index }) =>
      namePattern.test(token) &&
      !Object.hasOwn(constants, token.toLowerCase()) &&
      !isUnitAt(expression, index) &&
      !isCall(expression.slice(index + token.length)),
  );
  return new Set(names.map(([token]) => token));
}

/** Stands for a number that is not known: one by which hardly any expression divides by zero. */
const anyNumber = 0.7183;

/** Returns the first name that has no number, in an expression that is a number otherwise; undefined if there is none. */
export function unknownNameIn(expression: string, named: NamedNumbers): string | undefined {
  const unknown = [...namesIn(expression)].filter((name) => !named.has(name));
  const known = new Map([...named, ...unknown.map((name) => [name, anyNumber] as const)]);
  return readNumber(expression, known) === null ? undefined : unknown[0];
}

/** Returns whether a name is that of a function or constant. */
export const isReservedName = (name: string): boolean =>
  isFunction(name.toLowerCase()) || Object.hasOwn(constants, name.toLowerCase());

/** Returns the names of all functions and constants. */
export const reservedNames = (): readonly string[] => [...Object.keys(functions), ...Object.keys(constants)];

const degrees = Math.PI / 180;

/** Returns the sine of an angle in degrees; exact for multiples of 30° with a rational sine. */
function sine(angle: number): number {
  const exact = [0, 0.5, null, 1, null, 0.5, 0, -0.5, null, -1, null, -0.5][
    (((angle % 360) + 360) % 360) / 30
  ];
  return exact ?? Math.sin(angle * degrees);
}

/** Returns the tangent of an angle in degrees; exact for multiples of 45°: infinite for a right angle. */
function tangent(angle: number): number {
  const eighths = (((angle % 180) + 180) % 180) / 45;
  return [0, 1, Infinity, -1][eighths] ?? Math.tan(angle * degrees);
}

const functions = {
  sqrt: Math.sqrt,
  abs: Math.abs,
  sin: sine,
  cos: (angle: number) => sine(angle + 90),
  tan: tangent,
  asin: (x: number) => Math.asin(x) / degrees,
  acos: (x: number) => Math.acos(x) / degrees,
  atan: (x: number) => Math.atan(x) / degrees,
};

export type FunctionName = keyof typeof functions;

const isFunction = (name: string): name is FunctionName => Object.hasOwn(functions, name);

/** Returns the value of a function. Angles are in degrees. */
export const applied = (name: FunctionName, x: number): number => functions[name](x);

const constants: Readonly<Record<string, number>> = { pi: Math.PI };

/** Largest depth of nested parentheses, signs and exponents: deeper ones could exceed the stack. */
const maxDepth = 200;

/** A recursive-descent parser. Every method returns null if the text is invalid. */
class ExpressionReader {
  readonly #tokens: readonly string[];
  readonly #named: NamedNumbers;
  #next = 0;
  #depth = 0;

  constructor(tokens: readonly string[], named: NamedNumbers) {
    this.#tokens = tokens;
    this.#named = named;
  }

  get done(): boolean {
    return this.#next === this.#tokens.length;
  }

  sum(): number | null {
    let value = this.#product();
    for (let sign = this.#take("+", "-"); value !== null && sign; sign = this.#take("+", "-")) {
      const term = this.#product();
      value = term === null ? null : sign === "+" ? value + term : value - term;
    }
    return value;
  }

  #product(): number | null {
    let value = this.#inUnit(this.#factor());
    for (let sign = this.#take("*", "/"); value !== null && sign; sign = this.#take("*", "/")) {
      const factor = this.#factor();
      value = factor === null ? null : this.#inUnit(sign === "*" ? value * factor : value / factor);
    }
    return value;
  }

  /** Multiplies a value by the unit after it, if there is one. */
  #inUnit(value: number | null): number | null {
    const unit = this.#named.get(unitKey(this.#tokens[this.#next] ?? ""));
    if (value === null || unit === undefined) return value;
    ++this.#next;
    return value * unit;
  }

  /** Every recursion passes through here. */
  #factor(): number | null {
    if (this.#depth === maxDepth) return null;
    ++this.#depth;
    const value = this.#signed();
    --this.#depth;
    return value;
  }

  #signed(): number | null {
    const sign = this.#take("-", "+");
    if (sign) {
      const value = this.#factor();
      return value === null ? null : sign === "-" ? -value : value;
    }
    const base = this.#atom();
    if (base === null || !this.#take("^")) return base;
    const exponent = this.#factor();
    return exponent === null ? null : base ** exponent;
  }

  #atom(): number | null {
    const token = this.#tokens[this.#next++];
    if (token === undefined) return null;
    if (token === "(") return this.#closed();
    const lowerCase = token.toLowerCase();
    if (isFunction(lowerCase) && this.#take("(")) {
      const value = this.#closed();
      return value === null ? null : applied(lowerCase, value);
    }
    const constant = Object.hasOwn(constants, lowerCase) ? constants[lowerCase] : undefined;
    return constant ?? this.#named.get(token) ?? (/^[\d.]/.test(token) ? Number(token) : null);
  }

  #closed(): number | null {
    const value = this.sum();
    return this.#take(")") ? value : null;
  }

  #take(...tokens: readonly string[]): string | null {
    const token = this.#tokens[this.#next];
    if (token === undefined || !tokens.includes(token)) return null;
    ++this.#next;
    return token;
  }
}

/**
 * Reads a number the way people type it: `0.25`, `1/3`, `2*pi`, `(1+2)/4`, `1e-3`, `-sqrt(2)/2`, `3^2`, `sin(30)`. Angles are
 * in degrees.
 * Returns null for anything else, and for results that are not finite.
 */
export function readNumber(text: string): number | null {
  const tokens = text.toLowerCase().match(/\d+\.?\d*(?:e[+-]?\d+)?|\.\d+(?:e[+-]?\d+)?|[a-z]+|[-+*/^()]|\S/g);
  if (!tokens) return null;
  const reader = new ExpressionReader(tokens);
  const value = reader.sum();
  return reader.done && value !== null && Number.isFinite(value) ? value : null;
}

const degrees = Math.PI / 180;

/** Returns the sine of an angle in degrees; exact for multiples of 30° with a rational sine. */
function sine(angle: number): number {
  const exact = [0, 0.5, null, 1, null, 0.5, 0, -0.5, null, -1, null, -0.5][
    (((angle % 360) + 360) % 360) / 30
  ];
  return exact ?? Math.sin(angle * degrees);
}

const functions: Readonly<Record<string, (x: number) => number>> = {
  sqrt: Math.sqrt,
  abs: Math.abs,
  sin: sine,
  cos: (angle) => sine(angle + 90),
  tan: (angle) => Math.tan(angle * degrees),
  asin: (x) => Math.asin(x) / degrees,
  acos: (x) => Math.acos(x) / degrees,
  atan: (x) => Math.atan(x) / degrees,
};

const constants: Readonly<Record<string, number>> = { pi: Math.PI };

/** A recursive-descent parser. Every method returns null if the text is invalid. */
class ExpressionReader {
  readonly #tokens: readonly string[];
  #next = 0;

  constructor(tokens: readonly string[]) {
    this.#tokens = tokens;
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
    let value = this.#factor();
    for (let sign = this.#take("*", "/"); value !== null && sign; sign = this.#take("*", "/")) {
      const factor = this.#factor();
      value = factor === null ? null : sign === "*" ? value * factor : value / factor;
    }
    return value;
  }

  #factor(): number | null {
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
    const apply = functions[token];
    if (apply) {
      const value = this.#take("(") ? this.#closed() : null;
      return value === null ? null : apply(value);
    }
    return constants[token] ?? (/^[\d.]/.test(token) ? Number(token) : null);
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

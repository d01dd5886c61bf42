/**
 * Reads a number the way people type it: `0.25`, `1/3`, `2*pi`, `(1+2)/4`, `1e-3`, `-sqrt(2)/2`.
 * Returns null for anything else, and for results that are not finite.
 */
export function readNumber(text: string): number | null {
  const tokens = text.toLowerCase().match(/\d+\.?\d*(?:e[+-]?\d+)?|\.\d+(?:e[+-]?\d+)?|[a-z]+|[-+*/()]|\S/g);
  if (!tokens) return null;
  const reader = new ExpressionReader(tokens);
  const value = reader.sum();
  return reader.done && value !== null && Number.isFinite(value) ? value : null;
}

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
    const token = this.#tokens[this.#next++];
    if (token === undefined) return null;
    if (token === "(") return this.#closed();
    if (token === "sqrt") {
      if (!this.#take("(")) return null;
      const value = this.#closed();
      return value === null ? null : Math.sqrt(value);
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

/**
 * Formulas as HTML, made when the site is built. The policy of the pages forbids style attributes, so each style of a formula
 * becomes a class, and the page gets one sheet of them.
 */
import katex from "katex";

const macros = { "\\live": "{\\htmlData{show=#1}{#2}}" };
const livePattern = /\\live\{([^{}]*)\}\{([^{}]*)\}/g;

/** Returns the values in a formula: `\live{B.h}{1.15}` names `B.h`. */
export const liveValuesIn = (tex: string): readonly string[] =>
  [...tex.matchAll(livePattern)].map(([, value = ""]) => value);

/** Stands after each formula in a line until `withPunctuation` has removed it. */
const endOfFormula = "<!--end of formula-->";

/** Returns HTML with punctuation after formulas moved into their last parts: otherwise a line could begin with it. */
export function withPunctuation(html: string): string {
  const closing = "</span>".repeat(4);
  return html
    .replaceAll(
      new RegExp(`${closing}${endOfFormula}([.,;:!?]+)`, "g"),
      (_whole, marks: string) => `<span class="after">${marks}</span>${closing}`,
    )
    .replaceAll(endOfFormula, "");
}

export class FormulaSheet {
  readonly #classes = new Map<string, string>();

  /** Returns the HTML of a formula. Throws if KaTeX cannot read it. */
  render(tex: string, isDisplayed: boolean): string {
    const html = katex.renderToString(tex, {
      displayMode: isDisplayed,
      output: "html",
      throwOnError: true,
      strict: false,
      trust: ({ command }) => command === "\\htmlData",
      macros: { ...macros },
    });
    const tag = isDisplayed ? "div" : "span";
    const name = isDisplayed ? "formula displayed" : "formula";
    // A wide formula scrolls, by keys too.
    const focus = isDisplayed ? ' tabindex="0"' : "";
    const end = isDisplayed ? "" : endOfFormula;
    return `<${tag} class="${name}" role="math"${focus} aria-label="${attribute(spoken(tex))}">${this.#withoutStyles(html)}</${tag}>${end}`;
  }

  /** Returns the styles of all formulas rendered so far; empty if there are none. */
  get css(): string {
    return [...this.#classes].map(([style, name]) => `.${name}{${style}}`).join("");
  }

  #withoutStyles(html: string): string {
    return html.replace(
      /<([a-z]+)([^>]*?) style="([^"]*)"([^>]*)>/g,
      (_tag, element: string, before: string, style: string, after: string) => {
        const name = this.#classOf(style.replaceAll("&quot;", '"'));
        const attributes = `${before}${after}`;
        const known = /class="/.test(attributes);
        return known
          ? `<${element}${attributes.replace('class="', `class="${name} `)}>`
          : `<${element} class="${name}"${attributes}>`;
      },
    );
  }

  #classOf(style: string): string {
    const known = this.#classes.get(style);
    if (known !== undefined) return known;
    const name = `f${this.#classes.size}`;
    this.#classes.set(style, name);
    return name;
  }
}

/** Commands without arguments that are spoken by other words than their names. */
const words: Readonly<Record<string, string>> = {
  sum: "sum of",
  int: "integral of",
  cdot: "times",
  max: "maximum of",
  dots: "…",
  le: "≤",
};
/** Commands that only say how something is set. */
const silent = /\\(?:left|right|bigl|bigr|Bigl|Bigr|q?quad|displaystyle)(?![a-z])|(?<!\\)\\[,;!: ]/gi;
const power = (exponent: string): string =>
  ({ "2": "squared", "3": "cubed", "-1": "inverse", T: "transposed" })[exponent] ??
  `to the power of ${exponent}`;

/** Returns a formula for a reader who hears it. The page replaces `{B.h}` by the value. */
export function spoken(tex: string): string {
  let text = tex
    .replaceAll(livePattern, " \u0001$1\u0002 ")
    .replaceAll(silent, " ")
    .replaceAll(
      /\\begin\{pmatrix\}([^]*?)\\end\{pmatrix\}/g,
      (_whole, rows: string) =>
        ` the matrix with the rows ${rows
          .split("\\\\")
          .map((row) => row.replaceAll("&", ","))
          .join("; ")} `,
    )
    .replaceAll(/\\\\(?:\[[^\]]*\])?/g, "; ")
    .replaceAll(/\\(?:begin|end)\{[^}]*\}|&/g, " ")
    .replaceAll(/''/g, " double prime ");
  // From the inside out: an argument has no braces once those in it are spoken.
  const argument = String.raw`\s*(?:\{([^{}]*)\}|(\w))`;
  const rules: readonly (readonly [RegExp, (...parts: (string | undefined)[]) => string])[] = [
    [/\\(?:mathbf|mathrm|mathsf|text)(?:\{([^{}]*)\}|\s+(\w))/g, (_whole, a, b) => ` ${a ?? b} `],
    [new RegExp(String.raw`\\sqrt${argument}`, "g"), (_whole, a, b) => ` square root of ( ${a ?? b} ) `],
    [
      new RegExp(String.raw`\\[td]?frac${argument}${argument}`, "g"),
      (_whole, a, b, c, d) => ` fraction ${a ?? b} over ${c ?? d}, `,
    ],
    // Upper indices of the coordinates, as in the paper.
    [/\\alpha\^(?:\{(\w+)\}|(\w))/g, (_whole, a, b) => ` alpha ${a ?? b} `],
    [/\^(?:\{([^{}]*)\}|(\w))/g, (_whole, a, b) => ` ${power((a ?? b ?? "").trim())} `],
    [/_(?:\{([^{}]*)\}|(\w))/g, (_whole, a, b) => ` ${a ?? b} `],
  ];
  for (let before = ""; before !== text;) {
    before = text;
    for (const [pattern, speak] of rules) text = text.replaceAll(pattern, speak);
  }
  return text
    .replaceAll(/\\([a-z]+)/gi, (_whole, name: string) => ` ${words[name] ?? name} `)
    .replaceAll(/[{}]/g, " ")
    .replaceAll("\u0001", "{")
    .replaceAll("\u0002", "}")
    .replaceAll(/\s+/g, " ")
    .replaceAll(/ (?=[,;)])|(?<=\() /g, "")
    .replaceAll(/[,;](?=\S)/g, "$& ")
    .replace(/,$/, "")
    .trim();
}

/** Returns a text as it stands in an attribute in double quotes. */
export const attribute = (text: string): string =>
  text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

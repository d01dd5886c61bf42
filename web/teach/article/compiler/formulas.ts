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

/** Returns a formula for a reader who hears it. The page replaces `{B.h}` by the value. */
function spoken(tex: string): string {
  return tex
    .replace(livePattern, " \u0001$1\u0002 ")
    .replaceAll(/\\(?:begin|end)\{[^}]*\}|\\\\(?:\[[^\]]*\])?|\\[,;!]|\\q?quad|&/g, " ")
    .replaceAll(/\\(?:mathbf|mathrm|text)\{([^}]*)\}/g, "$1")
    .replaceAll(/\\sqrt/g, "square root of ")
    .replaceAll(/\\frac/g, "fraction ")
    .replaceAll(/\\le\b/g, "≤")
    .replaceAll(/\\([a-z]+)/gi, "$1")
    .replaceAll(/[{}]/g, " ")
    .replaceAll("\u0001", "{")
    .replaceAll("\u0002", "}")
    .replaceAll(/\s+/g, " ")
    .trim();
}

/** Returns a text as it stands in an attribute in double quotes. */
export const attribute = (text: string): string =>
  text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

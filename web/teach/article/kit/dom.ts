/** Returns an element with attributes and children. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Readonly<Record<string, string>> = {},
  ...children: readonly (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** Returns a button that acts. */
export function button(
  attributes: Readonly<Record<string, string>>,
  label: string,
  act: () => void,
): HTMLButtonElement {
  const made = element("button", { type: "button", ...attributes }, label);
  made.addEventListener("click", act);
  return made;
}

/** Returns a text with `_` and `^` before one character as subscript and superscript, and `*x*` in italics, `**x**` bold: `*α*^1**g**_1`. */
export function rich(text: string): DocumentFragment {
  const made = document.createDocumentFragment();
  for (const [part, bold, italic, low, high] of text.matchAll(
    /\*\*([^*]+)\*\*|\*([^*]+)\*|_(.)|\^(.)|[^*_^]+/gu,
  )) {
    if (bold !== undefined) made.append(element("b", {}, bold));
    else if (italic !== undefined) made.append(element("i", {}, italic));
    else if (low !== undefined) made.append(element("sub", {}, low));
    else if (high !== undefined) made.append(element("sup", {}, high));
    else made.append(part);
  }
  return made;
}

/** Returns a number with a true minus sign. */
export const digits = (value: number, places: number): string => {
  const text = Number.isFinite(value) ? value.toFixed(places) : value < 0 ? "-∞" : "∞";
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
};

/** The colours of the page's style sheet, for drawings. */
const names = [
  "ground",
  "plate",
  "ink",
  "soft",
  "faint",
  "rule",
  "void",
  "stone",
  "edge",
  "active",
  "refused",
  "new",
  "new-soft",
  "new-text",
  "rim",
  "hollow",
  "rock",
  "groove",
] as const;

export type ColourName = (typeof names)[number];
export type Colour = readonly [number, number, number];

let known: Readonly<Record<ColourName, Colour>> | null = null;
const listeners = new Set<() => void>();

/** Returns the colours of the present theme. They are read from a hidden element, which resolves `light-dark()`. */
export function colours(): Readonly<Record<ColourName, Colour>> {
  if (known) return known;
  const probe = document.createElement("span");
  probe.hidden = true;
  document.body.append(probe);
  const style = getComputedStyle(probe);
  const entries = names.map((name) => {
    probe.style.color = `var(--${name})`;
    const [r = 0, g = 0, b = 0] = (style.color.match(/[\d.]+/g) ?? []).map(Number);
    return [name, [r, g, b]];
  });
  probe.remove();
  known = Object.fromEntries(entries) as Record<ColourName, Colour>;
  return known;
}

/** Returns a colour as CSS writes it. */
export const css = ([r, g, b]: Colour, alpha = 1): string =>
  `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)} / ${Math.max(0, Math.min(1, alpha)).toFixed(3)})`;

/** Returns a colour between two; `t` from 0 to 1. */
export function mix(from: Colour, to: Colour, t: number): Colour {
  const at = (a: number, b: number): number => a + (b - a) * Math.max(0, Math.min(1, t));
  return [at(from[0], to[0]), at(from[1], to[1]), at(from[2], to[2])];
}

/** Calls back whenever the theme has changed. */
export function onTheme(listener: () => void): void {
  listeners.add(listener);
}

export function themeChanged(): void {
  known = null;
  for (const listener of listeners) listener();
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", themeChanged);
matchMedia("print").addEventListener("change", themeChanged);

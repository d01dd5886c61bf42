/** Texts can be read in both schemes: WCAG 2.2, success criterion 1.4.3. */
import { DEFAULT_THEME, mergeMantineTheme } from "@mantine/core";
import { expect, it } from "vitest";
import { cssVariables, theme } from "../../../web/ui/theme/theme";

/** The variables of colours that texts have, with names of Mantine or ours. */
const texts = ["dimmed", "placeholder", "error"].map((name) => `--mantine-color-${name}`);
const ownTexts = ["accent", "error", "warning", "success"].map((name) => `--tf-${name}`);
const backgrounds = ["panel", "rise", "menu", "overlay"].map((name) => `--tf-${name}`);

function luminance(color: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const value = parseInt(color.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * (r ?? NaN) + 0.7152 * (g ?? NaN) + 0.0722 * (b ?? NaN);
}

function contrast(a: string, b: string): number {
  const [dark, light] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return ((light ?? NaN) + 0.05) / ((dark ?? NaN) + 0.05);
}

it.each(["light", "dark"] as const)("texts have a contrast of 4.5 on all backgrounds, in %s", (scheme) => {
  const variables = new Map(Object.entries(cssVariables(mergeMantineTheme(DEFAULT_THEME, theme))[scheme]));
  const colorOf = (name: string): string => variables.get(name) ?? `there is no ${name}`;
  const low = [...texts, ...ownTexts]
    .flatMap((text) =>
      backgrounds.map((back) => [text, back, contrast(colorOf(text), colorOf(back))] as const),
    )
    .filter(([, , ratio]) => !(ratio >= 4.5));
  expect(low).toEqual([]);
});

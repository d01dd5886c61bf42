// The font of the page without what nothing shows: weights and features that no style asks for. It is a third smaller.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import subsetFont from "subset-font";
import { inRoot } from "./paths.mjs";

const NAME = "inter-latin-wght-normal.woff2";
const SOURCE = inRoot("node_modules", "@fontsource-variable", "inter", "files", NAME);

/** The weights between which the styles of the page choose. */
export const WEIGHTS = { min: 400, max: 700 };

/** Marks and kerning, arrows of hyphens, and digits of one width. */
const FEATURES = ["calt", "ccmp", "kern", "locl", "mark", "mkmk", "tnum"];

/** The characters for which the styles use this file, as they state them (`unicode-range`), and the arrows of the lessons. */
export const RANGES = [
  [0x00, 0xff],
  [0x131, 0x131],
  [0x152, 0x153],
  [0x2bb, 0x2bc],
  [0x2c6, 0x2c6],
  [0x2da, 0x2da],
  [0x2dc, 0x2dc],
  [0x304, 0x304],
  [0x308, 0x308],
  [0x329, 0x329],
  [0x2000, 0x206f],
  [0x20ac, 0x20ac],
  [0x2122, 0x2122],
  [0x2190, 0x2193],
  [0x2212, 0x2212],
  [0x2215, 0x2215],
  [0xfeff, 0xfeff],
  [0xfffd, 0xfffd],
];

const charactersOf = ([first, last]) =>
  Array.from({ length: last - first + 1 }, (_, i) => String.fromCodePoint(first + i)).join("");

/** Makes the smaller font. Returns an alias of Vite: styles that name the font of the package get this one. */
export async function smallerFont() {
  const font = await subsetFont(readFileSync(SOURCE), RANGES.map(charactersOf).join(""), {
    targetFormat: "woff2",
    keepFeatures: FEATURES,
    variationAxes: { wght: WEIGHTS },
  });
  const file = inRoot("build", "fonts", NAME);
  mkdirSync(path.dirname(file), { recursive: true });
  writeFileSync(file, font);
  return { find: /^.*\/inter-latin-wght-normal\.woff2$/, replacement: file };
}

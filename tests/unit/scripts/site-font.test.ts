/** The smaller font of the site has all that its styles ask for. */
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { expect, test } from "vitest";
import { RANGES, WEIGHTS } from "../../../scripts/lib/site-font.mjs";

const FILE = "inter-latin-wght-normal.woff2";

/** Returns the styles of the site with their fonts. */
function styles(): { readonly name: string; readonly text: string }[] {
  const own = readdirSync("web", { recursive: true, encoding: "utf8" })
    .filter((name) => name.endsWith(".css") && !/^(dist|node_modules)\b/.test(name))
    .map((name) => path.join("web", name));
  const inter = createRequire(import.meta.url).resolve("@fontsource-variable/inter/index.css");
  return [...own, inter].map((name) => ({ name, text: readFileSync(name, "utf8") }));
}

const faces = styles().flatMap(({ name, text }) =>
  [...text.matchAll(/@font-face\s*\{[^}]*\}/g)].map(([face]) => ({ name, face })),
);

test("every range of characters of the font is in it", () => {
  const using = faces.filter(({ face }) => face.includes(FILE));
  expect(using.length).toBeGreaterThan(1);
  for (const { name, face } of using) {
    const ranges = /unicode-range:\s*([^;]+)/i.exec(face)?.[1]?.split(",") ?? [];
    expect(ranges.length, name).toBeGreaterThan(0);
    for (const range of ranges) {
      const [first = 0, last = first] = range
        .trim()
        .slice(2)
        .split("-")
        .map((code) => Number.parseInt(code, 16));
      const isThere = RANGES.some(([from = 1, to = 0]) => from <= first && last <= to);
      expect(isThere, `${name}: ${range}`).toBe(true);
    }
  }
});

test("all weights that styles ask for are in it, but for fonts of their own", () => {
  const weights = styles().flatMap(({ name, text }) =>
    name.startsWith("web")
      ? [...text.replaceAll(/@font-face\s*\{[^}]*\}/g, "").matchAll(/([^{}]*)\{([^{}]*)\}/g)].flatMap(
          ([, , rule = ""]) => {
            const weight = Number(/font-weight:\s*(\d+)/.exec(rule)?.[1]);
            return Number.isNaN(weight) || /font-family/.test(rule) ? [] : [{ name, weight }];
          },
        )
      : [],
  );
  expect(weights.length).toBeGreaterThan(20);
  const outside = weights.filter(({ weight }) => weight < WEIGHTS.min || weight > WEIGHTS.max);
  // The text of lessons has a serif font with weights of its own.
  expect(outside.filter(({ name }) => !name.endsWith("page.css"))).toEqual([]);
});

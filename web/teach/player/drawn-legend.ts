/** The legends of a drawing of the front: what its colours and its marks mean. For a white page. */
import { viewerColors } from "../../ui/theme/theme";
import { viridis } from "../../ui/theme/viridis";
import { escaped, letterWidth, svgFont } from "./svg";

/** What the legends need of a view. */
interface Page {
  readonly width: number;
  readonly height: number;
}

const textColor = viewerColors.light.point;
/** Distance from the borders, size of the scale, and height of a line, in pixels. */
const margin = 12;
const bar = { width: 12, height: 110 } as const;
const lineHeight = 16;

/** Shape and colour of the marks, by what they mean. */
const marks: Readonly<Record<string, { readonly color: string; readonly isRound: boolean }>> = {
  base: { color: viewerColors.light.selection, isRound: false },
  joined: { color: viewerColors.light.front, isRound: false },
  ideal: { color: viewerColors.light.source, isRound: true },
  candidate: { color: viewerColors.light.point, isRound: true },
  failing: { color: viewerColors.light.failing, isRound: false },
};

const textAt = (x: number, y: number, text: string, rest = ""): string =>
  `<text x="${x}" y="${y}" fill="${textColor}" font-family="sans-serif" font-size="${svgFont}"${rest}>${escaped(text)}</text>`;

/** Returns the scale of the faces' colours at the upper right, with its ends and its name. */
export function scaleLegend(name: string, [low, high]: readonly [string, string], { width }: Page): string {
  const steps = viridis.map(
    (color, i) => `<stop offset="${i / (viridis.length - 1)}" stop-color="${color}"/>`,
  );
  const x = width - margin - bar.width;
  const end = ` text-anchor="end"`;
  return [
    `<g data-part="scale">`,
    `<defs><linearGradient id="scale" x1="0" y1="1" x2="0" y2="0">${steps.join("")}</linearGradient></defs>`,
    `<rect x="${x}" y="${margin}" width="${bar.width}" height="${bar.height}" fill="url(#scale)"/>`,
    textAt(x - 6, margin + svgFont, high, end),
    textAt(x - 6, margin + bar.height, low, end),
    textAt(x - 6, margin + (bar.height + svgFont) / 2, name, end),
    "</g>",
  ].join("");
}

/** Returns what the marks mean, by their kinds, at the lower right; an empty text without any. */
export function markLegend(names: Readonly<Record<string, string>>, { width, height }: Page): string {
  const entries = Object.entries(names);
  if (entries.length === 0) return "";
  const longest = Math.max(...entries.map(([, name]) => name.length));
  const x = width - margin - letterWidth * longest;
  const lines = entries.map(([kind, name], i) => {
    const y = height - margin - lineHeight * (entries.length - 1 - i);
    const { color = textColor, isRound = false } = marks[kind] ?? {};
    const sign = isRound
      ? `<circle cx="${x - 10}" cy="${y - 4}" r="4.5" fill="${color}"/>`
      : `<rect x="${x - 14.5}" y="${y - 8.5}" width="9" height="9" fill="${color}"/>`;
    return sign + textAt(x, y, name);
  });
  return `<g data-part="legend">${lines.join("")}</g>`;
}

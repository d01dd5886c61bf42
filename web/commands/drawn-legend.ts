/** The legend of the view on a picture, as the page shows it. */

/** CSS pixels around the legend, within it, and from its edge to that of the picture. */
const padding = 8;
const margin = 10;
const barWidth = 11;
const barHeight = 116;
const gap = 7;
const swatch = 11;
const row = 17;
const font = "11px";

interface Entry {
  /** Colours from the bottom to the top. */
  readonly colors: readonly string[];
  readonly ticks: readonly string[];
  readonly caption: string;
}

const textOf = (element: Element | null): string => element?.textContent.trim() ?? "";

/** Returns the colours of a gradient as the browser writes it, or the one colour. */
const colorsIn = (background: string): readonly string[] =>
  background.match(/rgba?\([^)]*\)|#[0-9a-f]+/gi) ?? [];

const backgroundOf = (element: Element): string => {
  const { backgroundImage, backgroundColor } = getComputedStyle(element);
  return backgroundImage === "none" ? backgroundColor : backgroundImage;
};

function entryOf(figure: Element): Entry {
  const [bar, ticks] = figure.children;
  const lines = [...(figure.querySelector("figcaption")?.children ?? [])].map(textOf);
  return {
    colors: bar ? colorsIn(backgroundOf(bar)) : [],
    ticks: [...(ticks?.children ?? [])].map(textOf),
    caption: lines.length > 0 ? lines.join(" ") : textOf(figure.querySelector("figcaption")),
  };
}

/**
 * Draws the legend of an app in the lower right corner of a picture. `scale`: pixels of the picture for a CSS pixel. Without a
 * legend on the page, does nothing.
 */
export function drawLegend(page: ParentNode, paper: CanvasRenderingContext2D, scale: number): void {
  const figure = page.querySelector("figure[data-legend]");
  if (!figure) return;
  const { fontFamily, color, backgroundColor } = getComputedStyle(figure);
  paper.save();
  paper.scale(scale, scale);
  paper.font = `${font} ${fontFamily}`;
  const corner = { x: paper.canvas.width / scale - margin, y: paper.canvas.height / scale - margin };
  const box = (width: number, height: number): void => {
    paper.translate(corner.x - width - 2 * padding, corner.y - height - 2 * padding);
    paper.beginPath();
    paper.roundRect(0, 0, width + 2 * padding, height + 2 * padding, 4);
    paper.fillStyle = backgroundColor;
    paper.fill();
    paper.fillStyle = color;
    paper.translate(padding, padding);
  };
  if (figure.getAttribute("data-legend") === "list") drawList(figure, paper, box);
  else drawScale(entryOf(figure), paper, box);
  paper.restore();
}

type DrawBox = (width: number, height: number) => void;

function drawScale({ colors, ticks, caption }: Entry, paper: CanvasRenderingContext2D, box: DrawBox): void {
  const tickWidth = Math.max(...ticks.map((tick) => paper.measureText(tick).width));
  const lineHeight = 13;
  box(barWidth + gap + tickWidth + gap + lineHeight, barHeight);
  const text = paper.fillStyle;
  const gradient = paper.createLinearGradient(0, barHeight, 0, 0);
  const last = Math.max(1, colors.length - 1);
  colors.forEach((each, i) => gradient.addColorStop(i / last, each));
  paper.fillStyle = gradient;
  paper.fillRect(0, 0, barWidth, barHeight);
  paper.fillStyle = text;
  ticks.forEach((tick, i) => {
    const share = ticks.length > 1 ? i / (ticks.length - 1) : 0.5;
    // The first one hangs from the upper end, the last one stands on the lower end.
    paper.textBaseline = "middle";
    paper.fillText(tick, barWidth + gap, 5 + share * (barHeight - 10));
  });
  paper.translate(barWidth + 2 * gap + tickWidth + lineHeight / 2, barHeight / 2);
  paper.rotate(-Math.PI / 2);
  paper.textAlign = "center";
  paper.fillText(caption, 0, 0, barHeight);
}

/** A legend of colours with names. */
function drawList(figure: Element, paper: CanvasRenderingContext2D, box: DrawBox): void {
  const rows = [...figure.querySelectorAll("li")].map((item) => {
    const [mark, ...words] = item.querySelectorAll("span, b");
    return { color: mark ? getComputedStyle(mark).color : "transparent", name: words.map(textOf).join("  ") };
  });
  const width = Math.max(0, ...rows.map(({ name }) => paper.measureText(name).width));
  box(swatch + gap + width, rows.length * row);
  const text = paper.fillStyle;
  paper.textBaseline = "middle";
  rows.forEach(({ color, name }, i) => {
    const y = (i + 0.5) * row;
    paper.fillStyle = color;
    paper.fillRect(0, y - swatch / 2, swatch, swatch);
    paper.fillStyle = text;
    paper.fillText(name, swatch + gap, y);
  });
}

/** The front of a trace as a drawing of lines and areas (SVG), for slides and papers. */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { cross, dot, subtract } from "../../document/vectors";
import { playerStrings } from "../strings/player";
import { viewerColors } from "../../ui/theme/theme";
import { viridisAt } from "../../ui/theme/viridis";
import { fading, type FrontColoring, frontValues, shadeOf } from "./front-values";
import { placedAround } from "../../viewer/apart";
import type { Triangle } from "./crossing";
import { cornersOf } from "./judge";
import { markLegend, scaleLegend } from "./drawn-legend";
import { drawnMarks, lensMarks, type DrawnMark, type LensMarks, type MarkKind } from "./lens-marks";
import type { LensScene } from "./lens-scene";
import { modelOutline } from "./model-outline";
import type { FrontFaces } from "./player";
import { drawnRecovery, recoveryLegendOf, type RecoveryMarks } from "./recovery-marks";
import { escaped, letterWidth, svgFont as labelFont } from "./svg";

/** A view of the model on a plane. */
export interface DrawingView {
  /** Of the drawing, in pixels. */
  readonly width: number;
  readonly height: number;
  readonly eye: Position;
  /** Returns where a position appears, y downwards, also beside the drawing; null if it lies behind the eye or too far away. */
  readonly toScreen: (position: Position) => { readonly x: number; readonly y: number } | null;
}

export interface DrawnState {
  readonly step: number;
  readonly coloring: FrontColoring;
  readonly faces: FrontFaces;
  /** What the lens shows; null for the front alone, with the base face of the step outlined. */
  readonly scene: LensScene | null;
  /** What a step of recovery changes; null for other steps. */
  readonly recovered?: RecoveryMarks | null;
  /** Whether the front is faded behind what the lens shows. */
  readonly fades: boolean;
}

const texts = playerStrings;

/** Colour of edges, for a white page. */
export const edgeColor = "#10141a";
const baseColor = "#e8590c";
/** Colours of labels, for a white page. */
export const labelColors: Readonly<Record<MarkKind, string>> = {
  base: "#1864ab",
  ideal: "#1f7a33",
  candidate: "#1b232d",
  failing: "#c92a2a",
};
/** Height of the boxes of labels, in pixels. */
const labelHeight = 17;
/** Digits after the point of the drawing's coordinates. */
const digits = 2;

interface DrawnFace {
  readonly points: string;
  readonly depth: number;
  /** Colour of the scale, and its brightness. */
  readonly color: string;
  readonly light: number;
}

/** Returns the drawing, with the faces far from the eye first and the base face of the step outlined. O(n log n). */
export function frontDrawing(trace: Trace, state: DrawnState, view: DrawingView): string {
  const { step, coloring, faces, scene, recovered = null } = state;
  const isFaded = (scene !== null || recovered !== null) && state.fades;
  const values = frontValues(trace, coloring);
  const drawn: DrawnFace[] = [];
  const supposed = scene?.supposed;
  for (const face of trace.frontAt(supposed ? step - 1 : step)) {
    if (supposed?.left.includes(face)) continue;
    const corners = cornersOf(trace, face);
    const points = pointsOf(corners, view);
    const normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
    const toEye = subtract(view.eye, corners[0]);
    // Counter-clockwise seen from the empty side.
    if (points === null || (faces === "inside" && dot(normal, toEye) <= 0)) continue;
    const light = lightOf(normal, toEye);
    const color = viridisAt(shadeOf(values, values.valueOf(face), step));
    drawn.push({ points, depth: depthOf(corners, view.eye), color, light });
  }
  drawn.sort((a, b) => b.depth - a.depth);
  const areas = drawn.map((face) => area(face, isFaded ? awayOf(face, drawn) : null));
  const marks = recovered ? drawnAll(drawnRecovery, recovered, view) : baseOutline(trace, step, view);
  return svgOf(`${escaped(trace.header.name)}, step ${step} of ${trace.stepCount}`, view, [
    `<g stroke="${edgeColor}" stroke-width="0.6" stroke-linejoin="round">`,
    ...areas,
    "</g>",
    drawnOutline(modelOutline(trace), view),
    ...(scene ? drawnAll(drawnMarks, lensMarks(scene), view) : marks),
    scaleLegend(texts.legend[coloring], texts.legendEnds(coloring, ...values.rangeAt(step)), view),
    markLegend(scene ? texts.marks.legend : recovered ? recoveryLegendOf(recovered) : {}, view),
  ]);
}

/** Returns a drawing with an escaped title. */
export function svgOf(title: string, { width, height }: DrawingView, parts: readonly string[]): string {
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}">`,
    `<title>${title}</title>`,
    ...parts.filter((part) => part !== ""),
    "</svg>",
    "",
  ].join("\n");
}

function baseOutline(trace: Trace, step: number, view: DrawingView): readonly string[] {
  const shown = trace.stepAt(step);
  const points = shown?.kind === "advance" ? pointsOf(cornersOf(trace, shown.face), view) : null;
  return points === null
    ? []
    : [`<polygon points="${points}" fill="none" stroke="${baseColor}" stroke-width="2"/>`];
}

/** Returns the points of a polygon; null if one of them cannot be drawn. */
export function pointsOf(corners: Triangle, { toScreen }: DrawingView): string | null {
  const points = corners.map(toScreen);
  if (points.includes(null)) return null;
  return points.map((at) => (at ? `${at.x.toFixed(digits)},${at.y.toFixed(digits)}` : "")).join(" ");
}

/** Returns the distance of the middle of some corners from the eye. */
export function depthOf(corners: readonly Position[], eye: Position): number {
  const middle = [0, 1, 2].map(
    (axis) => corners.reduce((sum, corner) => sum + (corner[axis] ?? 0), 0) / corners.length,
  );
  return Math.hypot(...middle.map((x, axis) => x - (eye[axis] ?? 0)));
}

/** Returns the brightness of a face: the more it is turned to the eye, the brighter. */
export function lightOf(normal: Position, toEye: Position): number {
  const scale = Math.hypot(...normal) * Math.hypot(...toEye);
  return scale === 0 ? 1 : 0.55 + 0.45 * Math.abs(dot(normal, toEye) / scale);
}

/** Returns a colour of a given brightness. */
export const shaded = (color: string, light: number): string => mixed(color, (channel) => light * channel);

/** Returns a colour with a share of another one. */
const blended = (color: string, other: string, share: number): string =>
  mixed(color, (channel, at) => channel + share * (parseInt(other.slice(at, at + 2), 16) - channel));

/** Returns a colour with other values of its channels, 0 to 255; `at` is where a channel begins. */
function mixed(color: string, change: (channel: number, at: number) => number): string {
  const channels = [1, 3, 5].map((at) => Math.round(change(parseInt(color.slice(at, at + 2), 16), at)));
  return `#${channels.map((channel) => channel.toString(16).padStart(2, "0")).join("")}`;
}

/** Returns the share of white in a faded face: it grows from the nearest face, the last one, to the farthest, the first. */
function awayOf({ depth }: DrawnFace, drawn: readonly DrawnFace[]): number {
  const [far = depth, near = depth] = [drawn[0]?.depth, drawn.at(-1)?.depth];
  return fading.background + (far > near ? (fading.depth * (depth - near)) / (far - near) : 0);
}

/** Returns a face; `away`: the share of white in it if it is faded, else null. */
function area({ points, color, light }: DrawnFace, away: number | null): string {
  if (away === null) return `<polygon points="${points}" fill="${shaded(color, light)}"/>`;
  const plain = shaded(blended(color, viewerColors.light.meshPlain, fading.plain), light);
  const [fill, stroke] = [plain, edgeColor].map((of) => blended(of, "#ffffff", away));
  return `<polygon points="${points}" fill="${fill}" stroke="${stroke}"/>`;
}

/** The parts of some marks, and their labels. */
function drawnAll<Marks extends Pick<LensMarks, "labels">>(
  parts: readonly DrawnMark<Marks>[],
  marks: Marks,
  view: DrawingView,
): readonly string[] {
  return [...parts.flatMap((mark) => drawnMark(mark, mark.of(marks), view)), ...drawnLabels(marks, view)];
}

/** Returns the lines of the model, which are seen through everything, as in the view. */
function drawnOutline(ends: readonly Position[], view: DrawingView): string {
  const path = pathOf(ends, 2, view);
  return path === ""
    ? ""
    : `<path d="${path}" fill="none" stroke="${viewerColors.light.line}" stroke-width="1.2" stroke-linecap="round" data-part="outline"/>`;
}

/** Returns the path of segments or triangles, which have so many positions each, without those that cannot be drawn. */
export function pathOf(positions: readonly Position[], perPiece: 2 | 3, { toScreen }: DrawingView): string {
  const points = positions.map(toScreen);
  const pieces: string[] = [];
  for (let i = 0; i + perPiece <= points.length; i += perPiece) {
    const ends = points.slice(i, i + perPiece).flatMap((at) => (at ? [at] : []));
    if (ends.length === perPiece)
      pieces.push(`M${ends.map(({ x, y }) => `${x.toFixed(digits)} ${y.toFixed(digits)}`).join("L")}`);
  }
  return pieces.join("");
}

function drawnMark(
  mark: DrawnMark<never>,
  positions: readonly Position[],
  view: DrawingView,
): readonly string[] {
  const color = viewerColors.light[mark.color];
  if (mark.form === "dots")
    return positions
      .map(view.toScreen)
      .flatMap((at) =>
        at
          ? [
              `<circle cx="${at.x.toFixed(digits)}" cy="${at.y.toFixed(digits)}" r="${mark.size / 2}" fill="${color}" stroke="#ffffff"/>`,
            ]
          : [],
      );
  const path = pathOf(positions, mark.form === "faces" ? 3 : 2, view);
  if (path === "") return [];
  if (mark.form === "faces") return [`<path d="${path}" fill="${color}" fill-opacity="${mark.opacity}"/>`];
  const dash = mark.dash === undefined ? "" : ` stroke-dasharray="${0.6 * mark.dash} ${0.4 * mark.dash}"`;
  return [
    `<path d="${path}" fill="none" stroke="${color}" stroke-width="${mark.width}" stroke-linecap="round"${dash}/>`,
  ];
}

/** A label of the marks beside what it names, in pixels. */
export interface PlacedLabel {
  readonly kind: MarkKind;
  readonly text: string;
  readonly from: { readonly x: number; readonly y: number };
  readonly middle: { readonly x: number; readonly y: number };
  readonly width: number;
  readonly height: number;
}

/** Returns the labels of marks where a picture shows them, without those of what is out of view. */
export function placedLabels(
  { labels }: Pick<LensMarks, "labels">,
  view: DrawingView,
): readonly PlacedLabel[] {
  const shown = labels.flatMap(({ kind, text, position }) => {
    const at = view.toScreen(position);
    return at ? [{ ...at, kind, text, width: letterWidth * text.length + 8, height: labelHeight }] : [];
  });
  const places = placedAround(shown, view);
  return shown.flatMap(({ x, y, ...label }, i) => {
    const middle = places[i];
    return middle ? [{ ...label, from: { x, y }, middle }] : [];
  });
}

/** Returns the labels with lines to what they name. */
export function drawnLabels(marks: Pick<LensMarks, "labels">, view: DrawingView): readonly string[] {
  const labels = placedLabels(marks, view);
  const round = (value: number): string => value.toFixed(digits);
  const lines = labels.map(
    ({ kind, from, middle }) =>
      `<path d="M${round(from.x)} ${round(from.y)}L${round(middle.x)} ${round(middle.y)}" stroke="${labelColors[kind]}"/>`,
  );
  const plates = labels.map(({ kind, text, middle, width, height }) => {
    const color = labelColors[kind];
    const [left, top] = [middle.x - width / 2, middle.y - height / 2].map(round);
    return [
      `<rect x="${left}" y="${top}" width="${round(width)}" height="${height}" rx="3" fill="#ffffff" stroke="${color}"/>`,
      `<text x="${round(middle.x)}" y="${round(middle.y + 0.35 * labelFont)}" fill="${color}" font-family="sans-serif" font-size="${labelFont}" text-anchor="middle">${escaped(text)}</text>`,
    ].join("");
  });
  return [...lines, ...plates];
}

/** The front of a trace as a drawing of lines and areas (SVG), for slides and papers. */
import type { Trace } from "tetrafront";
import type { Position } from "../document/position";
import { cross, dot, subtract } from "../document/vectors";
import { viridisAt } from "../ui/theme/viridis";
import { type FrontColoring, frontValues, shadeOf } from "./front-values";
import type { Triangle } from "./crossing";
import { cornersOf } from "./judge";
import type { FrontFaces } from "./player";

/** A view of the model on a plane. */
export interface DrawingView {
  /** Of the drawing, in pixels. */
  readonly width: number;
  readonly height: number;
  readonly eye: Position;
  /** Returns where a position appears, y downwards; null if it is out of view. */
  readonly toScreen: (position: Position) => { readonly x: number; readonly y: number } | null;
}

export interface DrawnState {
  readonly step: number;
  readonly coloring: FrontColoring;
  readonly faces: FrontFaces;
}

const edgeColor = "#10141a";
const baseColor = "#e8590c";
/** Digits after the point of the drawing's coordinates. */
const digits = 2;

interface DrawnFace {
  readonly points: string;
  readonly depth: number;
  readonly fill: string;
}

/** Returns the drawing, with the faces far from the eye first and the base face of the step outlined. O(n log n). */
export function frontDrawing(trace: Trace, { step, coloring, faces }: DrawnState, view: DrawingView): string {
  const values = frontValues(trace, coloring);
  const drawn: DrawnFace[] = [];
  for (const face of trace.frontAt(step)) {
    const corners = cornersOf(trace, face);
    const points = pointsOf(corners, view);
    const normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
    const toEye = subtract(view.eye, corners[0]);
    // Counter-clockwise seen from the empty side.
    if (points === null || (faces === "inside" && dot(normal, toEye) <= 0)) continue;
    const light = lightOf(normal, toEye);
    const fill = shaded(viridisAt(shadeOf(values, values.valueOf(face), step)), light);
    drawn.push({ points, depth: depthOf(corners, view.eye), fill });
  }
  drawn.sort((a, b) => b.depth - a.depth);
  const areas = drawn.map(({ points, fill }) => `<polygon points="${points}" fill="${fill}"/>`);
  const { width, height } = view;
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}">`,
    `<title>${escaped(trace.header.name)}, step ${step} of ${trace.stepCount}</title>`,
    `<g stroke="${edgeColor}" stroke-width="0.6" stroke-linejoin="round">`,
    ...areas,
    "</g>",
    ...baseOutline(trace, step, view),
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

function pointsOf(corners: Triangle, { toScreen }: DrawingView): string | null {
  const points = corners.map(toScreen);
  if (points.includes(null)) return null;
  return points.map((at) => (at ? `${at.x.toFixed(digits)},${at.y.toFixed(digits)}` : "")).join(" ");
}

function depthOf(corners: Triangle, eye: Position): number {
  const middle = [0, 1, 2].map((axis) => corners.reduce((sum, corner) => sum + (corner[axis] ?? 0), 0) / 3);
  return Math.hypot(...middle.map((x, axis) => x - (eye[axis] ?? 0)));
}

/** Returns the brightness of a face: the more it is turned to the eye, the brighter. */
function lightOf(normal: Position, toEye: Position): number {
  const scale = Math.hypot(...normal) * Math.hypot(...toEye);
  return scale === 0 ? 1 : 0.55 + 0.45 * Math.abs(dot(normal, toEye) / scale);
}

function shaded(color: string, light: number): string {
  const channels = [1, 3, 5].map((at) => Math.round(light * parseInt(color.slice(at, at + 2), 16)));
  return `#${channels.map((channel) => channel.toString(16).padStart(2, "0")).join("")}`;
}

const escaped = (text: string): string =>
  text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

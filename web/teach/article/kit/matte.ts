/**
 * Bodies in space as opaque, matte faces with edges: light from the upper left, depth as colour from a pale rim to a deep blue
 * hollow, and a soft shadow on the ground. Faces are painted from far to near.
 */
import type { Position } from "../../../document/position";
import { cross, dot, mean, subtract, unit } from "../../../document/vectors";
import { colours, css, mix, type Colour } from "./colours";
import { clamp } from "./motion";
import type { Pen } from "./pen";
import type { Camera } from "./space";
import type { Pixel } from "./stage";

/** Where the light comes from. */
const light: Position = unit([-0.5, -0.55, 0.67]) ?? [0, 0, 1];
/** Where the light of shadows comes from: they stay near their bodies. */
const shadowLight: Position = [-0.52, -0.16, 1];
const shadowColour: Colour = [22, 27, 38];
/** Pixels that are surely outside of every canvas. */
const farOutside = 20_000;

/** A face of any number of corners. */
export interface Facet {
  readonly corners: readonly Position[];
  readonly colour: Colour;
  readonly edge?: { readonly colour: Colour; readonly width: number; readonly alpha?: number };
}

/** Returns the normal of a polygon; upwards if it has no area. */
export function normalOf([a = [0, 0, 0], b = a, c = a]: readonly Position[]): Position {
  return unit(cross(subtract(b, a), subtract(c, a))) ?? [0, 0, 1];
}

/** Returns a colour as the light makes it on a face, whichever of its sides is seen. */
export function lit(colour: Colour, corners: readonly Position[], eye: Position): Colour {
  const normal = normalOf(corners);
  const towards = dot(normal, subtract(eye, corners[0] ?? eye)) < 0 ? -1 : 1;
  const shade = 0.5 + 0.5 * towards * dot(normal, light);
  return mix(mix(colour, shadowColour, 0.26), colour, clamp(0.1 + 1.05 * shade, 0, 1));
}

/** Returns the colour of a front at a depth: 0 at its rim, 1 in its hollow. */
export const depthColour = (depth: number): Colour =>
  mix(colours().rim, colours().hollow, clamp(depth, 0, 1));

/** Returns whether a face looks to the eye with the side from which its corners are counter-clockwise. */
export const looksTo = (corners: readonly Position[], eye: Position): boolean =>
  dot(normalOf(corners), subtract(eye, corners[0] ?? eye)) > 0;

/** Paints faces from far to near. */
export function paint(pen: Pen, camera: Camera, facets: readonly Facet[]): void {
  const depths = facets.map(({ corners }) => camera.depth(mean(corners)));
  const order = facets.map((_facet, index) => index).sort((a, b) => (depths[b] ?? 0) - (depths[a] ?? 0));
  for (const index of order) {
    const facet = facets[index];
    if (facet)
      pen.polygon(
        facet.corners.map((corner) => camera.pixel(corner)),
        facet.colour,
        1,
        facet.edge,
      );
  }
}

/** Draws the shadow of polygons on the ground, with a soft border; on paper, whose scale moves such shadows, with a sharp one. */
export function softShadow(
  pen: Pen,
  camera: Camera,
  polygons: readonly (readonly Position[])[],
  ground = 0,
  strength = 1,
): void {
  const { context } = pen;
  const ratio = context.getTransform().a;
  const isPrinted = document.documentElement.dataset["printed"] === "true";
  const outside = isPrinted ? 0 : farOutside;
  context.save();
  if (!isPrinted) {
    context.shadowColor = css(shadowColour, 0.2 * strength);
    context.shadowBlur = 16 * ratio;
    context.shadowOffsetX = outside * ratio;
  }
  context.beginPath();
  for (const polygon of polygons) {
    const pixels = polygon.map((position): Pixel => {
      const [x, y] = camera.pixel(shadowOf(position, ground));
      return [x - outside, y];
    });
    pen.path(isCounterClockwise(pixels) ? pixels : pixels.toReversed(), false);
  }
  context.fillStyle = css(shadowColour, isPrinted ? 0.1 * strength : 1);
  context.fill();
  context.restore();
}

/** Returns where the shadow of a position falls on the ground. */
function shadowOf([x, y, z]: Position, ground: number): Position {
  const fall = (z - ground) / shadowLight[2];
  return [x - fall * shadowLight[0], y - fall * shadowLight[1], ground];
}

function isCounterClockwise(pixels: readonly Pixel[]): boolean {
  const area = pixels.reduce((sum, [x, y], i) => {
    const [u, v] = pixels[(i + 1) % pixels.length] ?? [0, 0];
    return sum + x * v - y * u;
  }, 0);
  return area > 0;
}

/** Draws parallel lines over a polygon: what is refused. */
export function hatch(pen: Pen, pixels: readonly Pixel[], colour: Colour, alpha = 0.8, spacing = 13): void {
  const { context } = pen;
  const sums = pixels.map(([x, y]) => x + y);
  const [ys, low, high] = [pixels.map(([, y]) => y), Math.min(...sums), Math.max(...sums)];
  const [top, bottom] = [Math.min(...ys), Math.max(...ys)];
  context.save();
  pen.path(pixels);
  context.clip();
  for (let sum = Math.ceil(low / spacing) * spacing; sum < high; sum += spacing)
    pen.line([sum - top, top], [sum - bottom, bottom], colour, 1.4, { alpha });
  context.restore();
}

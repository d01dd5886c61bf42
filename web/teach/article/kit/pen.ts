/** Draws in pixels: lines, polygons, dots and crosses in the widths of the lessons. */
import { css, type Colour } from "./colours";
import type { Pixel } from "./stage";

/** Widths of lines in pixels. */
export const widths = { mesh: 1, front: 2.25, strong: 3.25, active: 5 } as const;

export class Pen {
  constructor(readonly context: CanvasRenderingContext2D) {}

  line(
    from: Pixel,
    to: Pixel,
    colour: Colour,
    width: number,
    options: { alpha?: number; dash?: readonly number[] } = {},
  ): void {
    const { context } = this;
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.strokeStyle = css(colour, options.alpha);
    context.lineWidth = width;
    context.setLineDash([...(options.dash ?? [])]);
    context.stroke();
    context.setLineDash([]);
  }

  /** A thick line with a glow: the active side. */
  glow(from: Pixel, to: Pixel, colour: Colour, strength = 1): void {
    this.line(from, to, colour, 14, { alpha: 0.22 * strength });
    this.line(from, to, colour, widths.front + (widths.active - widths.front) * strength);
  }

  polygon(
    points: readonly Pixel[],
    fill: Colour | null,
    alpha = 1,
    stroke?: { colour: Colour; width: number; alpha?: number },
  ): void {
    const { context } = this;
    this.path(points);
    if (fill) {
      context.fillStyle = css(fill, alpha);
      context.fill();
    }
    if (stroke) {
      context.strokeStyle = css(stroke.colour, stroke.alpha);
      context.lineWidth = stroke.width;
      context.stroke();
    }
  }

  /** Draws polygons that do not overlap, all in one colour; much faster than one by one. */
  polygons(
    all: readonly (readonly Pixel[])[],
    fill: Colour,
    stroke: { colour: Colour; width: number },
    alpha = 1,
  ): void {
    const { context } = this;
    context.beginPath();
    for (const points of all) this.path(points, false);
    context.fillStyle = css(fill, alpha);
    context.fill();
    context.strokeStyle = css(stroke.colour);
    context.lineWidth = stroke.width;
    context.stroke();
  }

  /** Draws open lines, all in one colour. */
  polylines(all: readonly (readonly Pixel[])[], colour: Colour, width: number, alpha = 1): void {
    const { context } = this;
    context.beginPath();
    for (const points of all)
      points.forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    context.strokeStyle = css(colour, alpha);
    context.lineWidth = width;
    context.stroke();
  }

  /** Begins a closed path, or goes on with another loop of it. */
  path(points: readonly Pixel[], isFirst = true): void {
    if (isFirst) this.context.beginPath();
    points.forEach(([x, y], index) => (index === 0 ? this.context.moveTo(x, y) : this.context.lineTo(x, y)));
    this.context.closePath();
  }

  circle(
    [x, y]: Pixel,
    radius: number,
    fill: Colour | null,
    options: {
      alpha?: number;
      stroke?: Colour;
      width?: number;
      strokeAlpha?: number;
      dash?: readonly number[];
    } = {},
  ): void {
    const { context } = this;
    context.beginPath();
    context.arc(x, y, Math.max(0, radius), 0, 2 * Math.PI);
    if (fill) {
      context.fillStyle = css(fill, options.alpha);
      context.fill();
    }
    if (options.stroke) {
      context.setLineDash([...(options.dash ?? [])]);
      context.strokeStyle = css(options.stroke, options.strokeAlpha);
      context.lineWidth = options.width ?? 2;
      context.stroke();
      context.setLineDash([]);
    }
  }

  cross([x, y]: Pixel, radius: number, colour: Colour, width = 3, alpha = 1): void {
    this.line([x - radius, y - radius], [x + radius, y + radius], colour, width, { alpha });
    this.line([x + radius, y - radius], [x - radius, y + radius], colour, width, { alpha });
  }
}

/** Returns a pixel between two. */
export const between = (from: Pixel, to: Pixel, t: number): Pixel => [
  from[0] + (to[0] - from[0]) * t,
  from[1] + (to[1] - from[1]) * t,
];

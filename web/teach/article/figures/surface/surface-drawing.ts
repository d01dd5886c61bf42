/** Draws a patch in space: opaque matte faces, light and depth as colour, with its net, or with the triangles of its front. */
import type { Position } from "../../../../document/position";
import { cross, dot, mean, subtract, unit as unitOf } from "../../../../document/vectors";
import { colours, mix, type Colour } from "../../kit/colours";
import { Pen } from "../../kit/pen";
import type { PlanePoint } from "../../kit/plane-view";
import type { Camera } from "../../kit/space";
import type { Pixel } from "../../kit/stage";
import type { SurfaceMaps } from "./surface-maps";

/** Cells of the surface in a row, and cells from one line of the net to the next. */
const cells = 16;
const cellsPerLine = 2;
const light: Position = unitOf([-0.5, -0.55, 0.8]) ?? [0, 0, 1];
const shadow: Colour = [22, 34, 56];
/** Depths by which triangles are before the cells behind them, and lines before both. */
const before = { triangle: 0.12, line: 0.17 } as const;

/** Something at a depth, drawn by a function. */
interface Painted {
  readonly depth: number;
  readonly paint: () => void;
}

/** A triangle of the front. */
export interface SurfaceTriangle {
  readonly corners: readonly Position[];
  readonly fill: Colour;
  readonly edge: Colour;
}

export interface DrawnSurface {
  readonly maps: SurfaceMaps;
  readonly hasNet: boolean;
  readonly isNetLit: boolean;
  readonly triangles: readonly SurfaceTriangle[];
  /** Whether triangles cover the patch, so that no cell is seen. */
  readonly isCovered: boolean;
  /** Sides of the front. */
  readonly sides: readonly (readonly [Position, Position])[];
}

/** Draws the surface and what is on it, from far to near. */
export function drawSurface(context: CanvasRenderingContext2D, camera: Camera, drawn: DrawnSurface): void {
  const pen = new Pen(context);
  const c = colours();
  const at = (position: Position): Pixel => camera.pixel(position);
  const shadeOf = ([p, q, r]: readonly Position[], base: Colour, strength = 0.3): Colour => {
    if (!p || !q || !r) return base;
    const normal = unitOf(cross(subtract(q, p), subtract(r, p))) ?? [0, 0, 1];
    const isFront = dot(normal, subtract(camera.eye, p)) > 0;
    const bright = Math.max(0, dot(normal, light) * (isFront ? 1 : -1));
    // Far is deeper than near.
    const depth = (camera.depth(p) - camera.distance) / 3 + 0.5;
    return mix(mix(base, shadow, strength * (1 + 0.4 * Math.min(1, Math.max(0, depth)))), base, bright * 1.1);
  };
  const painted: Painted[] = [];
  if (!drawn.isCovered) {
    const steps = Array.from({ length: cells + 1 }, (_none, i) => i / cells);
    const grid = steps.map((eta) =>
      steps.map((xi) => {
        const { position } = drawn.maps.pointAt([xi, eta]);
        return { position, pixel: at(position), depth: camera.depth(position) };
      }),
    );
    const corner = (i: number, j: number): (typeof grid)[number][number] =>
      grid[j]?.[i] ?? { position: [0, 0, 0], pixel: [0, 0], depth: 0 };
    for (let j = 0; j < cells; j++)
      for (let i = 0; i < cells; i++) {
        const quad = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        const base = drawn.hasNet ? mix(c.void, c.active, 0.1) : c.void;
        const colour = shadeOf(
          quad.map(({ position }) => position),
          base,
        );
        const pixels = quad.map(({ pixel }) => pixel);
        // A stroke of the same colour closes the seams between cells.
        painted.push({
          depth: quad.reduce((sum, { depth }) => sum + depth / 4, 0),
          paint: () => pen.polygon(pixels, colour, 1, { colour, width: 1 }),
        });
      }
    if (drawn.hasNet)
      for (let line = 0; line <= cells; line += cellsPerLine)
        for (let i = 0; i < cells; i++)
          for (const [from, to] of [
            [corner(i, line), corner(i + 1, line)],
            [corner(line, i), corner(line, i + 1)],
          ] as const) {
            const isBorder = line === 0 || line === cells;
            const width = isBorder ? 2.25 : drawn.isNetLit ? 2 : 1;
            painted.push({
              depth: from.depth - before.line,
              paint: () =>
                pen.line(from.pixel, to.pixel, c.ink, width, {
                  alpha: isBorder ? 1 : drawn.isNetLit ? 0.9 : 0.42,
                }),
            });
          }
  }
  for (const { corners, fill, edge } of drawn.triangles) {
    // Their colours say how good they are: light and shadow change them little.
    const colour = shadeOf(corners, fill, 0.14);
    painted.push({
      depth: camera.depth(mean(corners)) - (drawn.isCovered ? 0 : before.triangle),
      paint: () => pen.polygon(corners.map(at), colour, 1, { colour: edge, width: 1.1 }),
    });
  }
  for (const [from, to] of drawn.sides)
    painted.push({
      depth: Math.min(camera.depth(from), camera.depth(to)) - before.line,
      paint: () => {
        pen.line(at(from), at(to), c.ink, 2.25);
        pen.circle(at(to), 2.2, c.ink);
      },
    });
  painted.sort((a, b) => b.depth - a.depth);
  for (const { paint } of painted) paint();
}

/** Draws the net of a square, or of the stretched one. */
export function drawNet(pen: Pen, at: (unit: PlanePoint) => Pixel, isLit: boolean): void {
  const c = colours();
  const corners: readonly PlanePoint[] = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ];
  pen.polygon(corners.map(at), c.void);
  const count = cells / cellsPerLine;
  for (let i = 1; i < count; i++) {
    const alpha = isLit ? 0.9 : 0.42;
    pen.line(at([i / count, 0]), at([i / count, 1]), c.ink, isLit ? 2 : 1, { alpha });
    pen.line(at([0, i / count]), at([1, i / count]), c.ink, isLit ? 2 : 1, { alpha });
  }
  pen.polygon(corners.map(at), null, 1, { colour: c.ink, width: 2.25 });
}

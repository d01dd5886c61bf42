/** Draws a front and its ellipse: here, and in the space of a tensor, where the ellipse is a circle. */
import { colours, css } from "../../kit/colours";
import { Pen, widths } from "../../kit/pen";
import type { PlanePoint } from "../../kit/plane-view";
import type { Pixel, Stage } from "../../kit/stage";
import { FrontDrawing, type DrawnFront } from "../front/front-drawing";
import { outOfSpaceOf, type Tensor, type TensorField, type Triangle } from "./tensor-rules";

/** Width of a stage in pixels below which lines are thinner. */
const smallStage = 300;
/** Columns and rows of the faint ellipses between the nodes of the background grid. */
const [columns, rows] = [9, 6] as const;

export interface Drawn {
  readonly front: DrawnFront;
  /** The triangle at the dot, if it is there already. */
  readonly triangle: Triangle | null;
  readonly dot: PlanePoint;
  readonly tensor: Tensor;
  readonly lit: string | null;
}

const unitCircle: readonly PlanePoint[] = Array.from({ length: 72 }, (_none, i): PlanePoint => [
  Math.cos((i * Math.PI) / 36),
  Math.sin((i * Math.PI) / 36),
]);

/** Returns points of an ellipse: where edges of length 1 in the tensor's space end. */
export const ellipseAround = ([x, y]: PlanePoint, tensor: Tensor, factor = 1): readonly PlanePoint[] =>
  unitCircle.map((point): PlanePoint => {
    const [dx, dy] = outOfSpaceOf(tensor, point);
    return [x + factor * dx, y + factor * dy];
  });

/** Draws the front, its triangle at the dot, and the ellipse around the dot. */
export function drawSide(stage: Stage, at: (point: PlanePoint) => Pixel, drawn: Drawn): void {
  const c = colours();
  const pen = new Pen(stage.context);
  const { lit, triangle } = drawn;
  new FrontDrawing(pen, at, stage.width < smallStage ? 0.62 : 0.85).draw(drawn.front);
  if (triangle)
    pen.polygon(triangle.map(at), c.active, lit === "triangle" ? 0.55 : 0.32, {
      colour: c.active,
      width: lit === "triangle" ? widths.active : 3,
    });
  pen.polygon(ellipseAround(drawn.dot, drawn.tensor).map(at), c.active, lit === "ellipse" ? 0.22 : 0.07, {
    colour: c.active,
    width: lit === "ellipse" ? 4 : 2.25,
  });
}

/** Draws ellipses between the nodes of the background grid, smaller than they are. */
export function drawField(stage: Stage, at: (point: PlanePoint) => Pixel, field: TensorField): void {
  const c = colours();
  const pen = new Pen(stage.context);
  const [width, height] = field.extent;
  const ellipses: (readonly Pixel[])[] = [];
  for (let i = 0; i < columns; i++)
    for (let j = 0; j < rows; j++) {
      const point: PlanePoint = [((i + 0.5) * width) / columns, ((j + 0.5) * height) / rows];
      ellipses.push(ellipseAround(point, field.tensorAt(point), 0.4).map(at));
    }
  pen.polygons(ellipses, c.active, { colour: c.active, width: 1.25 }, 0.1);
}

/** Draws the background grid: its corners, and its middle. */
export function drawGrid(pen: Pen, nodes: readonly Pixel[]): void {
  const middle = nodes[4];
  nodes.slice(0, 4).forEach((node, i) => {
    pen.line(node, nodes[(i + 1) % 4] ?? node, colours().faint, 1.25, { dash: [2, 4] });
    if (middle) pen.line(node, middle, colours().faint, 1.25, { dash: [2, 4] });
  });
}

/** Fades what is far from the middle of a round window. */
export function fadeOut({ context, width, height }: Stage, radius: number): void {
  const c = colours();
  const [x, y] = [width / 2, height / 2];
  const fade = context.createRadialGradient(x, y, radius * 0.5, x, y, radius);
  fade.addColorStop(0, css(c.ground, 0));
  fade.addColorStop(0.55, css(c.ground, 0.35));
  fade.addColorStop(1, css(c.ground, 1));
  context.fillStyle = fade;
  context.fillRect(0, 0, width, height);
}

/** The wind that a field of ellipses is made for, and the hill below it. */
import { colours } from "../../kit/colours";
import { Pen } from "../../kit/pen";
import type { PlanePoint, PlaneView } from "../../kit/plane-view";
import type { Pixel, Stage } from "../../kit/stage";
import { extent } from "./fields";
import { directionOf, ellipseOf, type TensorField } from "./tensor-rules";

/** The hill: where its top is, how high it is over its foot, and how wide. */
const hill = { x: extent[0] / 2, height: 0.165, width: 0.42 } as const;
/** Heights at which a line of the wind begins, and the length of its pieces. */
const heights = [0.08, 0.35, 0.6] as const;
const piece = 0.03;
const arrow = 7;

export function drawHill(stage: Stage, view: PlaneView): void {
  const [x0, low, x1] = view.window;
  const [left, right] = [view.point([0, 0])[0], view.point([stage.width, 0])[0]];
  const [from, to] = [Math.min(x0, left), Math.max(x1, right)];
  const count = 80;
  const ridge = Array.from({ length: count + 1 }, (_none, i): PlanePoint => {
    const x = from + ((to - from) * i) / count;
    return [x, low + 0.012 + hill.height * Math.exp(-(((x - hill.x) / hill.width) ** 2))];
  });
  const ground = [...ridge, [to, low - 1] as const, [from, low - 1] as const].map((point) =>
    view.pixel(point),
  );
  const c = colours();
  new Pen(stage.context).polygon(ground, c.stone, 1, { colour: c.edge, width: 1.5 });
  stage.label("hill", view.pixel([hill.x, low + 0.07]), { look: "soft" });
}

/** Lines along the long axes of the ellipses, from left to right. */
export function drawWind(pen: Pen, at: (point: PlanePoint) => Pixel, field: TensorField): void {
  const c = colours();
  for (const height of heights) {
    const line: PlanePoint[] = [[0.02, height]];
    while (line.length < 200) {
      const last = line.at(-1) ?? [0, 0];
      if (last[0] > extent[0] - 0.05 || last[1] < 0 || last[1] > extent[1]) break;
      const { angle, stretching } = ellipseOf(field.tensorAt(last));
      // Where no direction counts, the line ends.
      if (stretching < 1.15) break;
      const [dx, dy] = directionOf(angle);
      const turn = dx < 0 ? -piece : piece;
      line.push([last[0] + turn * dx, last[1] + turn * dy]);
    }
    const pixels = line.map(at);
    pen.polylines([pixels], c.active, 1.5, 0.4);
    const [tip, before] = [pixels.at(-1), pixels.at(-2)];
    if (!tip || !before) continue;
    const [dx, dy] = [tip[0] - before[0], tip[1] - before[1]];
    const far = Math.max(1, Math.hypot(dx, dy));
    const [u, v] = [(arrow * dx) / far, (arrow * dy) / far];
    for (const side of [-0.6, 0.6])
      pen.line(tip, [tip[0] - u + side * v, tip[1] - v - side * u], c.active, 1.5, { alpha: 0.55 });
  }
}

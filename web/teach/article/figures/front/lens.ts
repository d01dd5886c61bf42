/** A round window in a corner of the stage that shows the surroundings of the active side, enlarged. */
import { colours } from "../../kit/colours";
import { clamp } from "../../kit/motion";
import { between, type Pen } from "../../kit/pen";
import type { PlanePoint, PlaneView } from "../../kit/plane-view";
import type { Pixel, Stage } from "../../kit/stage";
import { FrontDrawing, type DrawnFront } from "./front-drawing";
import type { FilmStep } from "./front-film";

const maxScale = 5;
/** A lens that enlarges less is not worth its place. */
const minScale = 1.25;

const reasons = {
  behind: "behind the side",
  crosses: "crosses a side",
  "too-close": "too close to a side",
  "same-node": "already a node",
  outside: "outside the shape",
} as const;

/** What the present beat shows, in words, and the role that gives the words their colour. */
export function captionOf(
  { candidates }: FilmStep,
  beat: number,
): { readonly text: string; readonly look: string } {
  const refusal = candidates.find((candidate) => candidate.refusal !== null)?.refusal;
  const accepted = candidates.find((candidate) => candidate.refusal === null);
  if (beat <= 1) return { text: "active side", look: "active" };
  if (beat <= 2) return { text: "ideal point", look: "active" };
  if (beat <= 3) {
    const isAlone = candidates.length === 1 && accepted?.isNew === true;
    return { text: isAlone ? "no node close by: a new one" : "candidates, in their order", look: "" };
  }
  if (refusal && beat <= 4) return { text: reasons[refusal], look: "refused" };
  if (!accepted) return { text: "no candidate: postponed", look: "refused" };
  if (beat <= 4) return { text: "nothing is in the way", look: "" };
  return { text: accepted.isNew ? "takes a new node" : "takes a node of the front", look: "new" };
}

export class Lens {
  constructor(
    readonly stage: Stage,
    readonly view: PlaneView,
    readonly pen: Pen,
  ) {}

  draw(drawn: DrawnFront, step: FilmStep): void {
    const { film } = drawn;
    const shown: readonly PlanePoint[] = [
      ...(film.sides[step.base]?.ends ?? []).map((node): PlanePoint => film.nodes[node] ?? [0, 0]),
      step.ideal,
      ...step.candidates.map(({ at }) => at),
    ];
    const [xs, ys] = [shown.map(([x]) => x), shown.map(([, y]) => y)];
    const centre: PlanePoint = [
      (Math.min(...xs) + Math.max(...xs)) / 2,
      (Math.min(...ys) + Math.max(...ys)) / 2,
    ];
    const spread = Math.max(...shown.map(([x, y]) => Math.hypot(x - centre[0], y - centre[1])));
    const radius = clamp(this.stage.width * 0.155, 54, 122);
    const scale = Math.min(maxScale * this.view.scale, (0.8 * radius) / spread);
    if (scale < minScale * this.view.scale) return;
    const at = this.#place(drawn, radius);
    this.#drawBeam(this.view.pixel(centre), clamp((radius / scale) * this.view.scale, 8, 400), at, radius);
    const { context } = this.pen;
    const c = colours();
    context.save();
    this.pen.circle(at, radius, c.ground);
    context.clip();
    const enlarged = ([x, y]: PlanePoint): Pixel => [
      at[0] + (x - centre[0]) * scale,
      at[1] - (y - centre[1]) * scale,
    ];
    new FrontDrawing(this.pen, enlarged, 1.25).draw(drawn);
    context.restore();
    this.pen.circle(at, radius, null, { stroke: c.ink, width: 1.75 });
    const { text, look } = captionOf(step, drawn.beat);
    const isHigh = at[1] < this.stage.height / 2;
    this.stage.label(text, at, {
      dy: isHigh ? radius + 16 : -radius - 16,
      look: `${look} plate`,
    });
  }

  /** The corner of the stage that holds least of the shape. */
  #place({ film }: DrawnFront, radius: number): Pixel {
    const { width, height } = this.stage;
    const margin = radius + 3;
    const corners: readonly Pixel[] = [
      [width - margin, margin],
      [width - margin, height - margin],
      [margin, margin],
      [margin, height - margin],
    ];
    const boundary = film.nodes.slice(0, film.boundaryNodes).map((node) => this.view.pixel(node));
    const hidden = corners.map(
      (corner) => boundary.filter(([x, y]) => Math.hypot(x - corner[0], y - corner[1]) < radius + 8).length,
    );
    return corners[hidden.indexOf(Math.min(...hidden))] ?? [margin, margin];
  }

  /** The circle that is enlarged, and a line from it to the window. */
  #drawBeam(from: Pixel, small: number, to: Pixel, large: number): void {
    const c = colours();
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    this.pen.circle(from, small, null, { stroke: c.faint, width: 1 });
    if (length > small + large)
      this.pen.line(between(from, to, small / length), between(from, to, 1 - large / length), c.faint, 1);
  }
}

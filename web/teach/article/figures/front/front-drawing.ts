/** Draws a state of the front in the plane, and the present step up to its beat; in the figure and in its lens alike. */
import { colours, mix } from "../../kit/colours";
import { clamp, ease } from "../../kit/motion";
import { between, type Pen, widths } from "../../kit/pen";
import type { PlanePoint } from "../../kit/plane-view";
import type { Pixel } from "../../kit/stage";
import type { FilmCandidate, FilmStep, FrontFilm } from "./front-film";

export interface DrawnFront {
  readonly film: FrontFilm;
  /** Loops of the shape. */
  readonly loops: readonly (readonly PlanePoint[])[];
  readonly step: number;
  readonly beat: number;
  /** The part that a word of the text lights. */
  readonly lit: string | null;
}

/** Dots of the front's nodes, in pixels. */
const dotRadius = 2.4;

export class FrontDrawing {
  constructor(
    readonly pen: Pen,
    readonly at: (point: PlanePoint) => Pixel,
    /** Factor of the widths: larger in the lens, smaller on phones. */
    readonly boldness: number,
  ) {}

  draw(drawn: DrawnFront): void {
    this.#drawFilled(drawn);
    this.#drawFront(drawn);
    const step = drawn.beat > 0 ? drawn.film.stepAt(drawn.step) : undefined;
    if (step) this.#drawStep(drawn, step);
    if (drawn.lit === "worst") this.#drawWorst(drawn.film);
  }

  /** Empty is cool; filled is warm, the newest warmest. */
  #drawFilled({ film, loops, step }: DrawnFront): void {
    const c = colours();
    const { context } = this.pen;
    loops.forEach((loop, i) => this.pen.path(loop.map(this.at), i === 0));
    context.fillStyle = `rgb(${c.void.join(" ")})`;
    context.fill("evenodd");
    const span = Math.max(12, film.triangles.length / 5);
    const isFull = step === film.stepCount;
    const edge = { colour: c.edge, width: widths.mesh * this.boldness };
    const standing = film.triangles.filter(({ born }) => born <= step);
    const ageOf = (born: number): number => (isFull ? 1 : clamp(((step - born) / span) * 1.2, 0, 1));
    const pointsOf = (corners: readonly number[]): readonly Pixel[] =>
      corners.map((node) => this.at(film.nodes[node] ?? [0, 0]));
    // All old triangles have one colour, and are drawn at once, which is much faster than one by one.
    const old = standing.filter(({ born }) => ageOf(born) === 1);
    this.pen.polygons(
      old.map(({ corners }) => pointsOf(corners)),
      c.stone,
      edge,
    );
    for (const { corners, born } of standing.slice(old.length))
      this.pen.polygon(pointsOf(corners), mix(c["new-soft"], c.stone, ageOf(born)), 1, edge);
    const outline = { colour: c.edge, width: 2 * this.boldness };
    for (const loop of loops) this.pen.polygon(loop.map(this.at), null, 1, outline);
  }

  #drawFront({ film, step, lit }: DrawnFront): void {
    const c = colours();
    const isLit = lit === "front";
    const isDimmed = lit !== null && !isLit;
    const seen = new Set<number>();
    const width = (isLit ? widths.active - 0.5 : widths.front) * this.boldness;
    const sides: (readonly Pixel[])[] = [];
    for (const { ends, born, died } of film.sides) {
      if (born > step || died <= step) continue;
      sides.push(ends.map((node) => this.at(film.nodes[node] ?? [0, 0])));
      for (const node of ends) seen.add(node);
    }
    this.pen.polylines(sides, c.ink, width, isDimmed ? 0.55 : 1);
    for (const node of seen)
      this.pen.circle(this.at(film.nodes[node] ?? [0, 0]), dotRadius * this.boldness, c.ink);
  }

  /** Beats: 1 the active side, 2 the ideal point, 3 the candidates, 4 the test, 5 the new triangle. */
  #drawStep({ film, beat, lit }: DrawnFront, step: FilmStep): void {
    const c = colours();
    const [a, b] = (film.sides[step.base]?.ends ?? [0, 0]).map((node) =>
      this.at(film.nodes[node] ?? [0, 0]),
    ) as [Pixel, Pixel];
    const middle = between(a, b, 0.5);
    const t = [0, 1, 2, 3, 4].map((i) => ease(beat - i)) as [number, number, number, number, number];
    const fades = 1 - t[4];
    const chosen = step.candidates.findIndex(({ refusal }) => refusal === null);
    const last = chosen < 0 ? step.candidates.length : chosen;
    step.candidates.slice(0, last + 1).forEach((candidate, i) => {
      const out = ease(clamp(t[2] * 1.6 - i * 0.15, 0, 1));
      if (out > 0 && fades > 0) this.#drawCandidate(candidate, [a, b], middle, out, fades);
    });
    // The triangle that is accepted comes after the test, and under what the test shows.
    const accepted = step.candidates[chosen];
    if (accepted && t[4] > 0) {
      const colour = mix(c["new-soft"], c.new, 1 - 0.6 * t[4]);
      const alpha = 0.35 + 0.5 * t[4];
      this.pen.polygon([a, b, between(middle, this.at(accepted.at), t[4])], colour, alpha, {
        colour: c.new,
        width: 2.5 * this.boldness,
      });
    }
    this.pen.glow(a, b, c.active, t[0] * (lit === "active" ? 1.4 : 1) * (1 - 0.6 * t[4]));
    if (t[1] > 0 && fades > 0) this.#drawIdeal(middle, this.at(step.ideal), t[1], fades, lit === "ideal");
    step.candidates.forEach((candidate, i) => {
      const shown = clamp(t[3] * (last + 1) - i, 0, 1);
      if (candidate.refusal !== null && shown > 0 && fades > 0)
        this.#drawRefusal(film, candidate, [a, b], shown * fades);
    });
  }

  #drawIdeal(middle: Pixel, ideal: Pixel, grown: number, alpha: number, isLit: boolean): void {
    const c = colours();
    const to = between(middle, ideal, grown);
    this.pen.line(middle, to, c.active, 1.6 * this.boldness, { alpha });
    if (grown < 0.3) return;
    if (isLit) this.pen.circle(to, 14, c.active, { alpha: 0.25 });
    this.pen.circle(to, 5.5 * this.boldness, c.plate, {
      alpha,
      stroke: c.active,
      width: 2.5,
      strokeAlpha: alpha,
    });
  }

  #drawCandidate(
    { at }: FilmCandidate,
    [a, b]: readonly [Pixel, Pixel],
    middle: Pixel,
    out: number,
    fades: number,
  ): void {
    const c = colours();
    const to = between(middle, this.at(at), out);
    for (const end of [a, b])
      this.pen.line(end, to, c.ink, 1.3 * this.boldness, { alpha: 0.5 * fades, dash: [3, 4] });
    if (out > 0.5)
      this.pen.circle(to, 4 * this.boldness, c.ink, {
        alpha: fades,
        stroke: c.ground,
        width: 1.5,
        strokeAlpha: fades,
      });
  }

  #drawRefusal(
    film: FrontFilm,
    { at, culprit }: FilmCandidate,
    [a, b]: readonly [Pixel, Pixel],
    alpha: number,
  ): void {
    const c = colours();
    const to = this.at(at);
    this.pen.polygon([a, b, to], c.refused, 0.1 * alpha);
    for (const end of [a, b])
      this.pen.line(end, to, c.refused, 1.8 * this.boldness, { alpha: 0.9 * alpha, dash: [5, 4] });
    const side = culprit === null ? undefined : film.sides[culprit];
    if (!side) return this.pen.cross(to, 6.5 * this.boldness, c.refused, 3, alpha);
    const [u, v] = side.ends.map((node) => this.at(film.nodes[node] ?? [0, 0])) as [Pixel, Pixel];
    this.pen.line(u, v, c.refused, 4 * this.boldness, { alpha });
    const meeting = meetingOf([a, to], [u, v]) ?? meetingOf([b, to], [u, v]) ?? to;
    this.pen.cross(meeting, 6.5 * this.boldness, c.refused, 3, alpha);
  }

  #drawWorst(film: FrontFilm): void {
    const triangle = film.triangles[film.worst.triangle];
    if (!triangle) return;
    const points = triangle.corners.map((node) => this.at(film.nodes[node] ?? [0, 0]));
    this.pen.polygon(points, colours().active, 0.28, { colour: colours().active, width: 3 });
  }
}

/** Returns where two segments meet; null if they do not. */
function meetingOf([a, b]: readonly [Pixel, Pixel], [u, v]: readonly [Pixel, Pixel]): Pixel | null {
  const [d, e, f] = [
    [b[0] - a[0], b[1] - a[1]],
    [v[0] - u[0], v[1] - u[1]],
    [u[0] - a[0], u[1] - a[1]],
  ] as const;
  const area = d[0] * e[1] - d[1] * e[0];
  if (area === 0) return null;
  const [s, t] = [(f[0] * e[1] - f[1] * e[0]) / area, (f[0] * d[1] - f[1] * d[0]) / area];
  return s > 0 && s <= 1 && t >= 0 && t <= 1 ? between(a, b, s) : null;
}

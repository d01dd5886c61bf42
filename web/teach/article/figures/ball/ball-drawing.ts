/** Draws the ball: the front as the wall of a hollow, elements as stones around it, and one step from near. */
import type { AdvanceStep } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { addScaled, between, distance, dot, mean, scale, subtract } from "../../../../document/vectors";
import { colours, mix, type Colour } from "../../kit/colours";
import { depthColour, lit, looksTo, normalOf, paint, softShadow, type Facet } from "../../kit/matte";
import { clamp, ease } from "../../kit/motion";
import { between as betweenPixels, type Pen } from "../../kit/pen";
import type { Camera } from "../../kit/space";
import type { Pixel, Stage } from "../../kit/stage";
import type { BallElement, BallFace, BallFilm } from "./ball-film";

export interface DrawnBall {
  readonly film: BallFilm;
  readonly state: number;
  /** Only elements and faces beyond this y are drawn. */
  readonly cut: number;
  /** 0: in place, 1: far apart. */
  readonly open: number;
  /** Whether new elements fly from the hollow to the wall. */
  readonly isPlaying: boolean;
  readonly lit: string | null;
}

/** Height of the ground below the ball. */
const ground = -1.08;
/** Steps that an element flies. */
const flight = 34;
/** Steps after which an element has the colour of stone. */
const youth = 150;
/** Faces farther from the base face than this many edges are not drawn in one step. */
const neighbourhood = 3.3;

export class BallDrawing {
  constructor(
    readonly stage: Stage,
    readonly camera: Camera,
    readonly pen: Pen,
  ) {}

  /** Draws a state of the whole ball. */
  drawWhole(drawn: DrawnBall): void {
    this.#drawShadow(drawn);
    const facets = [...this.#stones(drawn), ...this.#wall(drawn), ...this.#flying(drawn)];
    paint(this.pen, this.camera, facets);
  }

  #drawShadow({ cut, open }: DrawnBall): void {
    const radius = 0.9 * (1 + 0.7 * open);
    const rim = Array.from({ length: 48 }, (_none, i): Position => {
      const angle = (i * Math.PI) / 24;
      const y = radius * Math.sin(angle);
      return [0.34 + radius * Math.cos(angle), Math.max(open > 0 ? y : cut, y), ground - 0.25 * open];
    });
    softShadow(this.pen, this.camera, [rim], ground - 0.25 * open);
  }

  /** Elements that stand; what a neighbour covers is not painted. */
  #stones({ film, state, cut, open, isPlaying, lit: part }: DrawnBall): readonly Facet[] {
    const c = colours();
    const settled = isPlaying ? state - flight : state;
    const stands = (element: BallElement | undefined): boolean =>
      element !== undefined && element.born <= settled && element.died > settled && element.middle[1] > cut;
    const edge = { colour: c.groove, width: 1, alpha: 0.55 };
    return film.elements.flatMap((element, index) => {
      if (!stands(element)) return [];
      const age = (state - element.born) / youth;
      const tint = ((index * 7919) % 100) / 100;
      const stone = mix(c.rock, c.edge, 0.45 * tint);
      const base =
        age < 1 && (part === "new" || age < 0.9) ? mix(c.new, stone, clamp(age * 1.15, 0, 1)) : stone;
      const by: Position = [element.middle[0], element.middle[1] - Math.max(-1, cut), element.middle[2]];
      return element.faces.flatMap(({ corners, beyond }): Facet[] => {
        const neighbour = beyond === null ? undefined : film.elements[beyond];
        if (open === 0 && stands(neighbour)) return [];
        // The front itself is drawn as the wall.
        const isFront = neighbour !== undefined && (neighbour.born > settled || neighbour.died <= settled);
        if (open === 0 && isFront) return [];
        const moved = open === 0 ? corners : corners.map((corner) => apart(corner, element.middle, by, open));
        if (!looksTo(moved, this.camera.eye)) return [];
        return [{ corners: moved, colour: lit(base, moved, this.camera.eye), edge }];
      });
    });
  }

  /** The faces of the front: pale at the rim, deep blue in the hollow. */
  #wall({ film, state, cut, open, isPlaying, lit: part }: DrawnBall): readonly Facet[] {
    const c = colours();
    if (open > 0) return [];
    const settled = isPlaying ? Math.max(0, state - flight) : state;
    const strong = part === "front" || part === "hollow";
    const edge = { colour: strong ? c.active : c.groove, width: strong ? 1.75 : 1, alpha: strong ? 1 : 0.5 };
    const shown = film.faces.filter(({ middle, born, died, owner }) => {
      if (born > settled || died <= settled) return false;
      const holder = owner === null ? middle : (film.elements[owner]?.middle ?? middle);
      return holder[1] > cut;
    });
    const walls = shown.map(({ corners, middle }): Facet => {
      const depth = clamp((middle[1] - Math.max(-1, cut)) / 1.1, 0, 1) ** 0.8;
      // Seen from outside, it is the stone of a geode.
      const { eye } = this.camera;
      const colour = looksTo(corners, eye) ? depthColour(depth) : c.rock;
      return { corners, colour: lit(colour, corners, eye), edge };
    });
    const rim = rimOf(shown).map((corners): Facet => {
      return { corners, colour: c.ink, edge: { colour: c.ink, width: 2.25 } };
    });
    return [...walls, ...rim];
  }

  /** Elements in flight come from the middle of the hollow to their place at the wall. */
  #flying({ film, state, cut, isPlaying }: DrawnBall): readonly Facet[] {
    if (!isPlaying) return [];
    const c = colours();
    const edge = { colour: c.groove, width: 1.25 };
    return film.elements.flatMap((element) => {
      if (element.born <= state - flight || element.born > state || element.middle[1] <= cut - 0.1) return [];
      const arrived = 1 - (1 - (state - element.born) / flight) ** 3;
      const far = (arrived - 1) * 0.9;
      const size = 0.25 + 0.75 * arrived;
      const by: Position = [
        element.middle[0] * far,
        (element.middle[1] - cut) * far,
        element.middle[2] * far,
      ];
      return element.faces.flatMap(({ corners }): Facet[] => {
        const moved = corners.map((corner): Position => {
          const own = subtract(corner, element.middle);
          return [0, 1, 2].map(
            (i) => (element.middle[i] ?? 0) + (own[i] ?? 0) * size + (by[i] ?? 0),
          ) as unknown as Position;
        });
        if (!looksTo(moved, this.camera.eye)) return [];
        return [{ corners: moved, colour: lit(c.new, moved, this.camera.eye), edge }];
      });
    });
  }

  /** Draws one step from near, as far as its beat. Faces that look away from the eye are outlines, so that nothing hides the step. */
  drawStep(film: BallFilm, state: number, step: AdvanceStep, beat: number): void {
    const base = film.faces[step.face];
    if (!base) return;
    this.#drawNearby(film, state, step, base.middle);
    const t = [0, 1, 2, 3, 4].map((i) => ease(beat - i)) as [number, number, number, number, number];
    const c = colours();
    const at = (position: Position): Pixel => this.camera.pixel(position);
    const corners = base.corners.map(at);
    const middle = at(base.middle);
    const fades = 1 - t[4];
    this.pen.polygon(corners, mix(c.active, c.plate, 0.15), 0.9 * t[0]);
    const accepted = step.candidates.find(({ verdict }) => verdict === "accepted");
    if (accepted && t[3] > 0.6)
      this.#drawNew(base.corners, between(base.middle, accepted.position, (t[3] - 0.6) / 0.4), t[4]);
    corners.forEach((corner, i) =>
      this.pen.glow(corner, corners[(i + 1) % 3] ?? corner, c.active, t[0] * (1 - 0.7 * t[4])),
    );
    step.candidates.forEach((candidate, i) => {
      const out = ease(clamp(t[2] * 1.5 - i * 0.15, 0, 1));
      if (out === 0 || fades === 0) return;
      const to = at(between(base.middle, candidate.position, out));
      const isJudged = clamp(t[3] * step.candidates.length - i, 0, 1) > 0.4;
      const isRefused = isJudged && candidate.verdict !== "accepted";
      const colour = isRefused ? c.refused : c.ink;
      for (const corner of corners)
        this.pen.line(corner, to, colour, isRefused ? 2 : 1.3, { alpha: fades, dash: [5, 4] });
      this.pen.circle(to, 4.5, colour, { alpha: fades, stroke: c.ground, width: 1.5, strokeAlpha: fades });
      if (isRefused) this.#drawRefusal(film, candidate, to, i === 0, fades);
    });
    if (t[1] > 0 && fades > 0) {
      const to = betweenPixels(middle, at(step.idealPoint), t[1]);
      this.pen.line(middle, to, c.active, 2, { alpha: fades });
      this.pen.circle(to, 6, c.plate, { alpha: fades, stroke: c.active, width: 2.5, strokeAlpha: fades });
      if (t[2] < 0.4) this.stage.label("ideal point", to, { dy: -18, look: "active plate" });
    }
    if (t[1] < 0.3) this.stage.label("active face", middle, { dy: 26, look: "active plate" });
  }

  #drawNearby(film: BallFilm, state: number, step: AdvanceStep, at: Position): void {
    const c = colours();
    const { eye } = this.camera;
    const edgeLength = step.targetEdge || 0.3;
    const reach = neighbourhood * edgeLength;
    const faces = film.faces.filter(
      ({ born, died, middle }) => born <= state && died > state && distance(middle, at) < reach,
    );
    const towards = this.camera.axes[2];
    const facets = faces.flatMap(({ corners, middle }): Facet[] => {
      if (!looksTo(corners, eye)) return [];
      const fade = clamp((distance(middle, at) / reach - 0.45) * 1.9, 0, 1);
      const depth = 0.2 - dot(subtract(middle, at), towards) / reach;
      const colour = mix(lit(depthColour(depth), corners, eye), c.ground, fade);
      return [{ corners, colour, edge: { colour: c.groove, width: 1, alpha: 0.6 * (1 - fade) } }];
    });
    paint(this.pen, this.camera, facets);
    for (const { corners, middle } of faces)
      if (!looksTo(corners, eye) && distance(middle, at) < reach * 0.6)
        this.pen.polygon(
          corners.map((corner) => this.camera.pixel(corner)),
          null,
          1,
          { colour: c.ink, width: 1, alpha: 0.3 },
        );
    this.#fadeOut();
  }

  /** What has been drawn fades towards the border of the stage. */
  #fadeOut(): void {
    const { width, height } = this.stage;
    const { context } = this.pen;
    context.save();
    context.globalCompositeOperation = "destination-in";
    context.translate(width / 2, height / 2);
    context.scale(width / 2, height / 2);
    const gradient = context.createRadialGradient(0, 0, 0.55, 0, 0, 1);
    gradient.addColorStop(0, "rgb(0 0 0 / 1)");
    gradient.addColorStop(1, "rgb(0 0 0 / 0)");
    context.fillStyle = gradient;
    context.fillRect(-1, -1, 2, 2);
    context.restore();
  }

  #drawNew(base: readonly Position[], apex: Position, done: number): void {
    const c = colours();
    const colour = mix(c.new, c.plate, 0.25 - 0.2 * done);
    const sides = base.map((corner, i): readonly Position[] => [corner, base[(i + 1) % 3] ?? corner, apex]);
    const edge = { colour: c["new-text"], width: 2 };
    const facets = sides.map((corners): Facet => ({
      corners,
      colour: lit(colour, corners, this.camera.eye),
      edge,
    }));
    this.pen.context.globalAlpha = 0.55 + 0.45 * done;
    paint(this.pen, this.camera, facets);
    this.pen.context.globalAlpha = 1;
  }

  #drawRefusal(
    film: BallFilm,
    { culprit, verdict }: AdvanceStep["candidates"][number],
    to: Pixel,
    isFirst: boolean,
    alpha: number,
  ): void {
    const c = colours();
    const face = culprit === null ? undefined : film.faces[culprit];
    if (!face) return this.pen.cross(to, 7, c.refused, 3, alpha);
    const corners = face.corners.map((corner) => this.camera.pixel(corner));
    this.pen.polygon(corners, c.refused, 0.45 * alpha, { colour: c.refused, width: 3, alpha });
    const middle = this.camera.pixel(face.middle);
    this.pen.cross(middle, 8, c.refused, 3.5, alpha);
    const text =
      verdict === "crosses" ? "crosses this face" : verdict === "behind" ? "behind this face" : "too close";
    if (isFirst) this.stage.label(text, middle, { dy: 30, look: "refused plate" });
  }
}

/** Returns the edges at which faces end: where the front is cut. */
function rimOf(faces: readonly BallFace[]): readonly (readonly Position[])[] {
  const ends = new Map<string, readonly Position[]>();
  for (const { nodes, corners } of faces)
    nodes.forEach((node, i) => {
      const [next = 0, from, to] = [nodes[(i + 1) % 3], corners[i], corners[(i + 1) % 3]];
      const key = `${Math.min(node, next)} ${Math.max(node, next)}`;
      if (ends.has(key)) ends.delete(key);
      else if (from && to) ends.set(key, [from, to]);
    });
  return [...ends.values()];
}

/** Returns a corner of an element that is moved apart from the others, and is a little smaller. */
function apart(corner: Position, middle: Position, by: Position, open: number): Position {
  const small = between(middle, corner, 1 - 0.14 * Math.min(1, 3 * open));
  return addScaled(small, by, 1.05 * open);
}

/** Returns from where a step is seen best: from the empty side, across the line between its candidates. */
export function viewOf(film: BallFilm, step: AdvanceStep): Position {
  const corners = film.faces[step.face]?.corners ?? [];
  const normal: Colour = normalOf(corners);
  const [first, last] = [step.candidates[0]?.position, step.candidates.at(-1)?.position];
  const along =
    first && last && first !== last
      ? subtract(last, first)
      : subtract(first ?? step.idealPoint, mean(corners));
  const raw = normalOf([[0, 0, 0], along, normal]);
  const side =
    Math.abs(normal[2] * 0.62 + raw[2] * 0.78 - 0.3) < Math.abs(normal[2] * 0.62 - raw[2] * 0.78 - 0.3)
      ? 1
      : -1;
  return addScaled(scale(normal, 0.62), raw, 0.78 * side);
}

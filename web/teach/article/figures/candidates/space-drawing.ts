/** Draws the neighbourhood of a face of the front: opaque faces, deeper ones darker; the base lies flat, and the empty side is up. */
import type { Position } from "../../../../document/position";
import { cross, dot, length, mean, scale, subtract, unit } from "../../../../document/vectors";
import { colours, mix, type Colour } from "../../kit/colours";
import { clamp, ease } from "../../kit/motion";
import { widths, type Pen } from "../../kit/pen";
import type { Camera } from "../../kit/space";
import type { Pixel } from "../../kit/stage";

export interface DrawnFace {
  readonly corners: readonly [Position, Position, Position];
  /** Whether it is in the way of the candidate that is shown. */
  readonly isCulprit: boolean;
}

export interface DrawnElement {
  readonly apex: Position;
  readonly look: "accepted" | "refused" | "idle";
}

const light: Position = unit([-0.5, -0.35, 0.8]) ?? [0, 0, 1];
/** Distances from the base, in its sides, between which faces fade. */
const fade = [1.15, 2.2] as const;
/** Faces nearer than this to the base, in its sides, are outlines if they turn their back to the eye. */
const outlined = 0.8;

export class SpaceDrawing {
  constructor(
    readonly camera: Camera,
    readonly pen: Pen,
  ) {}

  /** Draws the faces of the front; those that turn their back to the eye are outlines. */
  drawFront(faces: readonly DrawnFace[]): void {
    const c = colours();
    const isDark = c.ground[0] < 128;
    const [pale, deep]: readonly [Colour, Colour] = isDark
      ? [
          [92, 116, 150],
          [26, 40, 62],
        ]
      : [
          [226, 234, 243],
          [112, 141, 182],
        ];
    const sorted = faces
      .map((face) => ({ face, middle: mean(face.corners) }))
      .sort((a, b) => this.camera.depth(b.middle) - this.camera.depth(a.middle));
    const backs: (readonly Pixel[])[] = [];
    for (const { face, middle } of sorted) {
      const strength = 1 - ease((length(middle) - fade[0]) / (fade[1] - fade[0]));
      if (strength <= 0.01) continue;
      const pixels = face.corners.map((corner) => this.camera.pixel(corner));
      const normal = this.#normal(face.corners);
      if (dot(normal, subtract(this.camera.eye, middle)) <= 0) {
        if (length(middle) < outlined) backs.push(pixels);
        continue;
      }
      // What is high is near the eye of the front; the ground of the hollow is deep.
      const height = clamp((middle[2] + 0.35) / 1.5, 0, 1);
      const lit = 0.5 + 0.5 * dot(normal, light);
      const colour = mix(deep, pale, clamp(0.62 * height + 0.48 * lit - 0.06, 0, 1));
      this.pen.polygon(
        pixels,
        face.isCulprit ? mix(colour, c.refused, 0.6) : mix(c.ground, colour, strength),
        1,
        {
          colour: face.isCulprit ? c.refused : mix(c.ground, mix(colour, deep, 0.75), strength ** 2),
          width: face.isCulprit ? 3.5 : 1,
        },
      );
    }
    for (const pixels of backs)
      this.pen.polygon(pixels, null, 1, { colour: c.ink, width: 0.75, alpha: 0.16 });
  }

  drawBase(base: readonly Position[], isLit: boolean): void {
    const c = colours();
    const pixels = base.map((corner) => this.camera.pixel(corner));
    this.pen.polygon(pixels, mix(c.plate, c.active, 0.55), 1, {
      colour: c.active,
      width: isLit ? 8 : widths.active,
    });
  }

  /** Draws the element of a candidate, in opaque faces. */
  drawElement(base: readonly [Position, Position, Position], { apex, look }: DrawnElement): void {
    const c = colours();
    const [face, dark, edge] = {
      accepted: [mix(c["new-soft"], [255, 255, 255], 0.12), mix(c.new, [60, 40, 0], 0.12), c["new-text"]],
      refused: [mix([255, 255, 255], c.refused, 0.42), mix(c.refused, [40, 0, 0], 0.15), c.refused],
      idle: [mix(c.plate, c.ink, 0.14), mix(c.plate, c.ink, 0.42), c.ink],
    }[look] as [Colour, Colour, Colour];
    const [a, b, d] = base;
    const sides = [
      [a, b, apex],
      [b, d, apex],
      [d, a, apex],
    ] as const;
    for (const corners of [...sides].sort(
      (p, q) => this.camera.depth(mean(q)) - this.camera.depth(mean(p)),
    )) {
      const normal = this.#normal(corners);
      // Two sides that are seen always differ: the light comes from the left of the eye.
      const shade = clamp(0.5 - 0.62 * dot(normal, this.camera.axes[0]) + 0.2 * normal[2], 0, 1);
      const isFront = dot(normal, subtract(this.camera.eye, mean(corners))) > 0;
      if (!isFront) continue;
      this.pen.polygon(
        corners.map((corner) => this.camera.pixel(corner)),
        mix(dark, face, shade),
        1,
        { colour: edge, width: 2.5 },
      );
      this.pen.line(this.camera.pixel(corners[0]), this.camera.pixel(corners[1]), c.active, widths.active);
    }
  }

  /** Draws the edges of an element that is not chosen. */
  drawFan(
    base: readonly Position[],
    apex: Position,
    colour: Colour,
    alpha: number,
    dash: readonly number[],
  ): void {
    const to = this.camera.pixel(apex);
    for (const corner of base) this.pen.line(this.camera.pixel(corner), to, colour, 1.4, { alpha, dash });
  }

  #normal([a, b, c]: readonly [Position, Position, Position]): Position {
    const normal = cross(subtract(b, a), subtract(c, a));
    return scale(normal, 1 / (length(normal) || 1));
  }
}

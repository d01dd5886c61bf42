/** Two round windows beside the cube: the worst element of the front, and the element that stands in its place now. */
import type { Position } from "../../../../document/position";
import { add, cross, distance, dot, mean, scale, subtract, unit } from "../../../../document/vectors";
import { colours, mix } from "../../kit/colours";
import { digits } from "../../kit/dom";
import { lit } from "../../kit/matte";
import { between, type Pen } from "../../kit/pen";
import type { Camera } from "../../kit/space";
import type { Pixel, Stage } from "../../kit/stage";
import { measureFour, poorAngles, type Four } from "../sliver/sliver-rules";

/** Share of a window that the first element fills. */
const filling = 0.74;

export class SliverLens {
  constructor(
    readonly stage: Stage,
    readonly camera: Camera,
    readonly pen: Pen,
  ) {}

  draw(sliver: Four, now: Four): void {
    const { width, height } = this.stage;
    const isWide = width > 760;
    const radius = isWide ? 104 : Math.min(50, width / 7);
    const margin = radius + (isWide ? 26 : 4);
    const y = isWide ? height * 0.46 : radius + 4;
    const at = mean(sliver);
    this.#draw(sliver, sliver, [margin, y], radius, at, "before");
    this.#draw(now, sliver, [width - margin, y], radius, at, "now");
  }

  #draw(four: Four, sliver: Four, centre: Pixel, radius: number, at: Position, when: string): void {
    const c = colours();
    const { pen } = this;
    const place = this.camera.pixel(at);
    const far = Math.hypot(place[0] - centre[0], place[1] - centre[1]) || 1;
    pen.line(between(centre, place, radius / far), between(centre, place, 1 - 9 / far), c.soft, 1);
    pen.circle(place, 9, null, { stroke: c.ink, width: 1.75 });
    pen.circle(centre, radius, c.plate, { stroke: c.ink, width: 1.75 });
    const { angles } = measureFour(four);
    const least = Math.min(...angles);
    const isPoor = least < poorAngles.min || Math.max(...angles) > poorAngles.max;
    const [right, up, towards] = axesOf(sliver);
    const reach = Math.max(...sliver.map((corner) => distance(corner, at)));
    const middle = mean(four);
    const pixel = (position: Position): Pixel => {
      const by = scale(subtract(position, middle), (filling * radius) / reach);
      return [centre[0] + dot(by, right), centre[1] - dot(by, up)];
    };
    const { context } = pen;
    context.save();
    context.beginPath();
    context.arc(centre[0], centre[1], radius - 1, 0, 2 * Math.PI);
    context.clip();
    const faces = [0, 1, 2, 3].map((left) => four.filter((_corner, i) => i !== left));
    const base = isPoor ? mix(c.refused, c.plate, 0.3) : c.rock;
    const height = (face: readonly Position[]): number => dot(mean(face), towards);
    for (const face of faces.toSorted((a, b) => height(a) - height(b)))
      pen.polygon(face.map(pixel), lit(base, face, add(middle, scale(towards, 10))), 1, {
        colour: c.groove,
        width: 1.75,
      });
    context.restore();
    this.stage.label(`${when}: ${digits(least, 1)}°`, [centre[0], centre[1] + radius + 16], {
      look: isPoor ? "refused plate" : "plate",
    });
  }
}

/** Axes from which an element looks as flat as it is: to the right along its longest edge, a little above its plane. */
function axesOf(four: Four): readonly [Position, Position, Position] {
  const pairs = four.flatMap((a, i) => four.slice(i + 1).map((b) => subtract(b, a)));
  const longest = pairs.toSorted((a, b) => dot(b, b) - dot(a, a))[0] ?? [1, 0, 0];
  const right = unit(longest) ?? [1, 0, 0];
  const [a, b, c] = four;
  const normal = unit(cross(subtract(b, a), subtract(c, a))) ?? [0, 0, 1];
  const sideways = unit(cross(normal, right)) ?? [0, 1, 0];
  const towards = unit(add(sideways, scale(normal, 0.32))) ?? sideways;
  return [right, cross(towards, right), towards];
}

import { call, minus, plus, times, valueOf, type Quantities } from "../../expressions/quantity";
import { strings } from "../../strings";
import { turnBy, type QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";

const names = strings.pieces.patches;

/** Points along each side of a section. */
const pointsPerSide = 24;

/** A straight wing with a NACA section of four digits. Lengths in model units, angles in degrees. */
export type WingSizes = {
  /** Camber in % of the chord, its position in tenths, thickness in two digits: 2412. */
  readonly digits: number;
  readonly chord: number;
  readonly tipChord: number;
  readonly span: number;
  /** Angle by which the leading edge is swept back. */
  readonly sweep: number;
  /** Rotation of the tip about its quarter chord, nose up. */
  readonly twist: number;
};

/**
 * Returns a wing along the z axis: the leading edge of the root is at the origin, the chord along x, up along y. Two Coons
 * patches are ruled between splines at root and tip; both ends are planar. The trailing edge is sharp (last coefficient
 * 0.1036 instead of 0.1015; Jacobs, Ward & Pinkerton, NACA report 460, 1933). The splines pass through 24 points per side,
 * closer together at the edges, and deviate from the section by less than 0.05 % of the chord.
 */
export function wing(sizes: WingSizes): Shape;
export function wing(sizes: Quantities<WingSizes>): Shape<QuantityPosition>;
export function wing({
  digits,
  chord,
  tipChord,
  span,
  sweep,
  twist,
}: Quantities<WingSizes>): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const section = valueOf(digits);
  const back = times(span, call("tan", sweep));
  const root = addSection(builder, (x, y) => [times(chord, x), times(chord, y), 0], section);
  const [cosine, sine] = turnBy(twist);
  const tip = addSection(
    builder,
    (x, y) => {
      const [along, up] = [x - 0.25, y];
      const a = plus(plus(0.25, times(cosine, along)), times(sine, up));
      const b = minus(times(cosine, up), times(sine, along));
      return [plus(back, times(tipChord, a)), times(tipChord, b), span];
    },
    section,
  );
  const nose = builder.straight(root.nose, tip.nose);
  const tail = builder.straight(root.tail, tip.tail);
  builder.patch("planar", [[-root.lower, -root.upper]], names.root);
  builder.patch("planar", [[tip.upper, tip.lower]], names.tip);
  builder.patch("coons", [[root.upper, tail, -tip.upper, -nose]], names.upper);
  builder.patch("coons", [[root.lower, nose, -tip.lower, -tail]], names.lower);
  return builder.shape;
}

/** A section: the upper side from nose to tail, the lower side back. */
interface Section {
  readonly nose: number;
  readonly tail: number;
  readonly upper: number;
  readonly lower: number;
}

function addSection(
  builder: ShapeBuilder<QuantityPosition>,
  place: (x: number, y: number) => QuantityPosition,
  digits: number,
): Section {
  const nose = builder.point(place(0, 0));
  const tail = builder.point(place(1, 0));
  const inner = Array.from({ length: pointsPerSide }, (_, i) => noseCluster((i + 1) / (pointsPerSide + 1)));
  const side = (sign: 1 | -1): number[] =>
    inner.map((x) => builder.point(place(...onSection(digits, x, sign))));
  const [above, below] = [side(1), side(-1)];
  const upper = builder.line("spline", [nose, ...above, tail]);
  const lower = builder.line("spline", [tail, ...below.toReversed(), nose]);
  return { nose, tail, upper, lower };
}

/** Maps equal steps from 0 to 1 to positions along the chord that are closer together at both edges. */
const noseCluster = (share: number): number => (1 - Math.cos(Math.PI * share)) / 2;

/** Returns the position on the upper (1) or lower (-1) side of a section with chord 1, at x along the camber line. */
export function onSection(digits: number, x: number, sign: 1 | -1): readonly [x: number, y: number] {
  const camber = Math.floor(digits / 1000) / 100;
  const peak = (Math.floor(digits / 100) % 10) / 10;
  const thickness = (digits % 100) / 100;
  const half =
    5 * thickness * (0.2969 * Math.sqrt(x) + x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))));
  const [height, slope] = camberAt(camber, peak, x);
  const norm = Math.hypot(1, slope);
  return [x - (sign * half * slope) / norm, height + (sign * half) / norm];
}

/** Height and slope of the camber line. */
function camberAt(camber: number, peak: number, x: number): readonly [height: number, slope: number] {
  if (camber === 0 || peak === 0) return [0, 0];
  const isFront = x < peak;
  const factor = camber / (isFront ? peak ** 2 : (1 - peak) ** 2);
  const height = isFront ? 2 * peak * x - x * x : 1 - 2 * peak + 2 * peak * x - x * x;
  return [factor * height, 2 * factor * (peak - x)];
}

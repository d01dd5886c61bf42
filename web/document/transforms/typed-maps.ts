import { minus, plus, power, times, valueOf, type Quantity } from "../../expressions/quantity";
import {
  addQuantities,
  crossQuantities,
  dotQuantities,
  isPlain,
  quantityFrameAlong,
  scaleQuantities,
  subtractQuantities,
  turnBy,
  valuesOf,
  type QuantityPosition,
} from "../quantity-positions";
import { axisDirections, zero } from "../vectors";
import {
  meanFactor,
  reflectionAt,
  rotationAbout,
  scalingAbout,
  translation,
  type Affine,
  type TypedAffine,
} from "./affine";

/** Maps of space whose numbers may have been typed as expressions. */

export function typedTranslation(offset: QuantityPosition): Affine {
  const plain = translation(valuesOf(offset));
  if (isPlain(offset)) return plain;
  return { ...plain, typed: { columns: axisDirections, offset, factor: 1, rotates: false } };
}

/** As `rotationAbout`. The axis need not have the length 1. */
export function typedRotation(centre: QuantityPosition, axis: QuantityPosition, degrees: Quantity): Affine {
  const plain = rotationAbout(valuesOf(centre), valuesOf(axis), valueOf(degrees));
  const rotates = !isPlain(axis) || typeof degrees !== "number";
  if (!rotates && isPlain(centre)) return plain;
  const { z } = quantityFrameAlong(axis);
  const [cosine, sine] = turnBy(degrees);
  const column = (k: 0 | 1 | 2): QuantityPosition => {
    const along = scaleQuantities(z, z[k]);
    const across = subtractQuantities(axisDirections[k], along);
    const turned = scaleQuantities(crossQuantities(z, axisDirections[k]), sine);
    return [scaleQuantities(across, cosine), turned].reduce(addQuantities, along);
  };
  return { ...plain, typed: about(centre, [column(0), column(1), column(2)], 1, rotates) };
}

/** As `scalingAbout`. */
export function typedScaling(centre: QuantityPosition, factors: QuantityPosition): Affine {
  const plain = scalingAbout(valuesOf(centre), valuesOf(factors));
  if (isPlain(centre) && isPlain(factors)) return plain;
  const [x, y, z] = factors;
  const isEqual = minus(x, y) === 0 && minus(y, z) === 0 && valueOf(x) > 0;
  const product = times(times(x, y), z);
  const volume = valueOf(product) < 0 ? times(-1, product) : product;
  const factor = isEqual ? x : typeof volume === "number" ? meanFactor(plain) : power(volume, 1 / 3);
  return {
    ...plain,
    typed: about(
      centre,
      [
        [x, 0, 0],
        [0, y, 0],
        [0, 0, z],
      ],
      factor,
      false,
    ),
  };
}

/** As `reflectionAt`. The normal need not have the length 1. */
export function typedReflection(point: QuantityPosition, normal: QuantityPosition): Affine {
  const plain = reflectionAt(valuesOf(point), valuesOf(normal));
  if (isPlain(point) && isPlain(normal)) return plain;
  const n = quantityFrameAlong(normal).z;
  const column = (k: 0 | 1 | 2): QuantityPosition =>
    addQuantities(axisDirections[k], scaleQuantities(n, times(-2, n[k])));
  const columns = [column(0), column(1), column(2)] as const;
  const offset = scaleQuantities(n, times(2, dotQuantities(n, point)));
  return { ...plain, typed: { columns, offset, factor: 1, rotates: !isPlain(normal) } };
}

/** Returns the map with a linear part that leaves a centre where it is. */
function about(
  centre: QuantityPosition,
  columns: TypedAffine["columns"],
  factor: Quantity,
  rotates: boolean,
): TypedAffine {
  const linear: TypedAffine = { columns, offset: zero, factor, rotates };
  return { ...linear, offset: subtractQuantities(centre, mapQuantities(linear, centre)) };
}

/** Returns the map with the expressions that it was typed as; one of plain numbers, with the same values, without any. */
export const typedMap = (map: Affine): TypedAffine =>
  map.typed ?? { columns: map.columns, offset: map.offset, factor: meanFactor(map), rotates: false };

/** Returns the image of a direction: without the offset. */
export function mapQuantityDirection(
  { columns }: TypedAffine,
  direction: QuantityPosition,
): QuantityPosition {
  const part = (k: 0 | 1 | 2): Quantity =>
    columns.reduce<Quantity>((sum, column, axis) => plus(sum, times(column[k], direction[axis] ?? 0)), 0);
  return [part(0), part(1), part(2)];
}

/** Returns the image of a position whose coordinates may have been typed as expressions. */
export const mapQuantities = (map: TypedAffine, position: QuantityPosition): QuantityPosition =>
  addQuantities(mapQuantityDirection(map, position), map.offset);

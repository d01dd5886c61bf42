/** Units of length: converts the coordinates of files, and what is measured in them. */
import { type Steps, stepwise } from "../base/steps.js";
import type { Mesh } from "../mesh/mesh.js";
import { LENGTH_UNITS, type LengthUnit } from "../mesh/units.js";
import { ReadFailure } from "./read-result.js";

/** Length of a unit in micrometres, exact. */
const MICROMETRES: Readonly<Record<LengthUnit, number>> = {
  um: 1,
  mm: 1e3,
  cm: 1e4,
  m: 1e6,
  in: 25_400,
  ft: 304_800,
};

/** How the lengths of a file are converted when it is read. */
export interface LengthOptions {
  /** Factor of all coordinates, from 1e-30 to 1e30. Default 1. */
  readonly scale?: number | undefined;
  /** LengthUnit into which the lengths of the file are converted. Default: none. Requires that the file's unit is known. */
  readonly units?: LengthUnit | undefined;
  /** Unit of the file, if its format does not define one. */
  readonly fileUnits?: LengthUnit | undefined;
}

/** Divides both numbers by their common factors: multiplication and division by 1 are without rounding. */
function lowestTerms(numerator: number, denominator: number): [number, number] {
  let [divisor, rest] = [numerator, denominator];
  while (rest > 0) [divisor, rest] = [rest, divisor % rest];
  return [numerator / divisor, denominator / divisor];
}

/** Converts a length after the conversion to the unit of the file, which is the millimetre for files of CAD programs. */
export function lengthInFile(length: number, { scale = 1, units, fileUnits = "mm" }: LengthOptions): number {
  return (length * MICROMETRES[units ?? fileUnits]) / MICROMETRES[fileUnits] / scale;
}

/**
 * Returns the mesh in the wanted unit. Coordinates are multiplied by a whole number, divided by another one, and multiplied by
 * the scale: millimetres become metres like the decimal number. Converts the points that mark regions, their volumes, and
 * values at nodes named `size`. Throws a ReadFailure if the file's unit is unknown or contradicts the options.
 */
export function* inUnits(mesh: Mesh, { scale = 1, units, fileUnits }: LengthOptions): Steps<Mesh> {
  if (mesh.unit !== undefined && fileUnits !== undefined && fileUnits !== mesh.unit) {
    const message = `the format defines the unit of the file, ${mesh.unit}, but ${fileUnits} is given`;
    throw new ReadFailure({ code: "invalid-argument", message, remedy: "Omit `fileUnits`." });
  }
  const from = mesh.unit ?? fileUnits;
  if (units !== undefined && from === undefined) {
    const message = `the lengths cannot be converted to ${units}, because the file does not state its unit`;
    const remedy = `State it by \`fileUnits\`, one of ${LENGTH_UNITS.join(", ")}, or use \`scale\`.`;
    throw new ReadFailure({ code: "invalid-argument", message, remedy });
  }
  const to = units ?? from;
  const [numerator, denominator] =
    from === undefined || to === undefined ? [1, 1] : lowestTerms(MICROMETRES[from], MICROMETRES[to]);
  const convert = (x: number) => ((x * numerator) / denominator) * scale;
  const unit = to === undefined ? {} : { unit: to };
  if (from === to && scale === 1) return { ...mesh, ...unit };
  const converted = function* (values: Float64Array): Steps<Float64Array> {
    const result = new Float64Array(values.length);
    yield* stepwise(values.length, (i) => (result[i] = convert(values[i] ?? 0)));
    return result;
  };
  const nodeData = new Map(mesh.nodeData);
  const sizes = nodeData.get("size");
  if (sizes !== undefined) nodeData.set("size", { ...sizes, values: yield* converted(sizes.values) });
  const metrics = nodeData.get("metric");
  if (metrics !== undefined) {
    // A metric is the inverse of a squared length.
    const square = convert(1) ** 2;
    nodeData.set("metric", { ...metrics, values: metrics.values.map((value) => value / square) });
  }
  const { regionPoints, trueFaces } = mesh;
  const moved = <Point extends { readonly position: readonly [number, number, number] }>(
    point: Point,
  ): Point => {
    const [x, y, z] = point.position;
    return { ...point, position: [convert(x), convert(y), convert(z)] };
  };
  return {
    ...mesh,
    ...unit,
    ...(trueFaces && {
      trueFaces: trueFaces.map((faces) => ({
        ...faces,
        placement: { scale: convert(faces.placement?.scale ?? 1) },
      })),
    }),
    points: yield* converted(mesh.points),
    // Rounding may make points equal.
    isWelded: false,
    nodeData,
    ...(regionPoints && {
      regionPoints: {
        holes: regionPoints.holes.map(moved),
        regions: regionPoints.regions.map((point) => ({
          ...moved(point),
          maxVolume: point.maxVolume && point.maxVolume * convert(1) ** 3,
        })),
      },
    }),
  };
}

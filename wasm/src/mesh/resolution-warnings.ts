/** Warning about coordinates with few digits: far from the origin, numbers are too coarse for small triangles. */
import { type Steps, stepwise } from "../base/steps.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { SurfaceInput } from "./mesh.js";

/** Resolution of the coordinates / size of the surface above which its triangles are rounded visibly. */
const COARSE = 1e-4;

/** Largest coordinate / size of the surface below which it is not far from the origin. */
const FAR = 16;

/** Size of the surface / resolution up to which its shape is lost in any case. */
const FEW = 16;

/** Distance of neighbouring numbers / number: at most 2 to the power of minus these. */
const SINGLE_BITS = 23;
const DOUBLE_BITS = 52;

/** Number of significant digits of lengths. */
const DIGITS = 2;

/**
 * Returns a warning if the coordinates of a surface far from the origin are so coarse that they change the shape of the surface, and
 * an error if nothing is left of it. The coordinates of a file in single precision have about 7 digits, others about 16. O(n).
 */
export function* resolutionWarnings({ points }: SurfaceInput): Steps<Diagnostic[]> {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  let longer = 0;
  yield* stepwise(points.length, (i) => {
    const x = points[i] ?? 0;
    const k = i % 3;
    low[k] = Math.min(low[k] ?? x, x);
    high[k] = Math.max(high[k] ?? x, x);
    if (Math.fround(x) !== x) longer++;
  });
  const isSingle = longer === 0;
  const size = Math.hypot(...[0, 1, 2].map((k) => (high[k] ?? 0) - (low[k] ?? 0)));
  const largest = Math.max(...low.map(Math.abs), ...high.map(Math.abs));
  if (!(largest > FAR * size) || !Number.isFinite(largest)) return [];
  const resolution = 2 ** (Math.floor(Math.log2(largest)) - (isSingle ? SINGLE_BITS : DOUBLE_BITS));
  if (resolution <= COARSE * size) return [];
  // Numbers that need no more digits were not rounded; of a few different ones, nothing can be said.
  const isOdd = (x: number) => Math.abs(x) >= largest / 2 && Math.abs(x / resolution) % 2 === 1;
  const areFew = size <= FEW * resolution;
  if (!areFew && !points.some(isOdd)) return [];
  // Whole numbers may be exact.
  const isCertain = !areFew || points.some((x) => !Number.isInteger(x));
  const text = (length: number) => String(Number(length.toPrecision(DIGITS)));
  const digits = isSingle
    ? "single precision, with about 7 digits"
    : "double precision, with about 16 digits";
  const rounded = `where coordinates in ${digits}, are multiples of ${text(resolution)}`;
  const remedy = `Export it nearer to the origin${isSingle ? ", or with more digits" : ""}.`;
  if (size === 0) {
    const message = `all nodes of the surface are at one position, ${text(largest)} away from the origin, ${rounded}: its shape is lost`;
    return [packageDiagnostic("coarse-coordinates", message, remedy)];
  }
  const message = `the surface is ${text(size)} large and ${text(largest)} away from the origin, ${rounded}: its triangles ${isCertain ? "are" : "may be"} rounded to them`;
  return [packageDiagnostic("coarse-coordinates", message, remedy, "warning")];
}

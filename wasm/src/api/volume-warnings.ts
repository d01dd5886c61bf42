/** Whether a remeshed surface encloses as much as the given one. */
import { short } from "../base/short.js";
import { type Steps, stepwise } from "../base/steps.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { sentence } from "../diagnostics/package-diagnostic.js";
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import { NO_REGION } from "../generated/constants.js";
import type { SurfaceInput } from "../mesh/mesh.js";

/** Change of the volume / volume of the given surface above which the shape is another one. */
const CHANGED = 0.01;

/** Number of significant digits of volumes. */
const DIGITS = 3;

/**
 * Returns a warning if the volume of a surface changed much: within the tolerance, thin walls may lose most of theirs. `origin`: per
 * triangle of `made`, that of `given` from which it comes. Both must have the same orientation. O(n).
 */
export function* volumeWarnings(
  given: SurfaceInput,
  made: SurfaceInput,
  origin: Uint32Array,
): Steps<Diagnostic[]> {
  const { triangleRegions = new Uint32Array() } = given.givenRegions ?? {};
  // Interfaces bound the volumes on both sides.
  const isOuter = (t: number) =>
    triangleRegions.length === 0 ||
    triangleRegions[2 * t] === NO_REGION ||
    triangleRegions[2 * t + 1] === NO_REGION;
  const before = yield* enclosedVolume(given, isOuter);
  const after = yield* enclosedVolume(made, (t) => isOuter(origin[t] ?? 0));
  if (!(Math.abs(after - before) > CHANGED * Math.abs(before))) return [];
  const [one, other] = [before, after].map((volume) => short(Math.abs(volume), DIGITS));
  const warning: DiagnosticOf<"changed-volume"> = {
    code: "changed-volume",
    severity: "warning",
    message: sentence(`the given surface encloses a volume of ${one}, the remeshed one ${other}`),
    remedy: 'Use a smaller `tolerance`, or `surface: "keep"`.',
    entities: [],
    data: { given: before, made: after },
  };
  return [warning];
}

function* enclosedVolume(
  { points, triangles }: SurfaceInput,
  isCounted: (triangle: number) => boolean,
): Steps<number> {
  const first = triangles[0] ?? 0;
  let sum = 0;
  yield* stepwise(triangles.length / 3, (t) => {
    if (!isCounted(t)) return;
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    sum += sixfoldVolume(points, first, a, b, c).volume;
  });
  return sum / 6;
}

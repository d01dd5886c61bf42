/** Whether a remeshed surface encloses as much as the given one. */
import { short } from "../base/short.js";
import type { Steps } from "../base/steps.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { sentence } from "../diagnostics/package-diagnostic.js";
import { enclosedVolumes } from "../formats/sixfold-volume.js";
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
  const [before = 0] = yield* enclosedVolumes(given, 1, (t) => (isOuter(t) ? 0 : undefined));
  const [after = 0] = yield* enclosedVolumes(made, 1, (t) => (isOuter(origin[t] ?? 0) ? 0 : undefined));
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

/** Whether a remeshed surface encloses as much as the given one. */
import { short } from "../base/short.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { sentence } from "../diagnostics/package-diagnostic.js";
import type { SurfaceRemesh } from "../mesh/inspection.js";

/** Change of the volume / volume of the given surface above which the shape is another one. */
const CHANGED = 0.01;

/** Number of significant digits of volumes. */
const DIGITS = 3;

/** Returns a warning if the volume of a surface changed much: within the tolerance, thin walls may lose most of theirs. */
export function volumeWarnings({
  givenVolume: before,
  volume: after,
}: Pick<SurfaceRemesh, "givenVolume" | "volume">): Diagnostic[] {
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

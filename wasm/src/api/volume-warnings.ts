/** Whether a remeshed surface encloses as much as the given one. */
import { short } from "../base/short.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { sentence } from "../diagnostics/package-diagnostic.js";
import type { SurfaceRemesh } from "../mesh/inspection.js";

/** Change of the volume / volume of the given surface above which it is reported. */
const CHANGED = 0.01;

/** Number of significant digits of volumes. */
const DIGITS = 3;

/**
 * Returns a warning if the volume of a surface changed much: within the tolerance, thin walls may lose most of theirs. If all nodes
 * are on the true faces of a solid, the shape is right, and a note says how much of it flat triangles leave out.
 */
export function volumeWarnings({
  givenVolume: before,
  volume: after,
  onFaces,
  failedFaces,
}: Pick<SurfaceRemesh, "givenVolume" | "volume" | "onFaces" | "failedFaces">): Diagnostic[] {
  const change = after / before - 1;
  if (!(Math.abs(change) > CHANGED)) return [];
  if (onFaces && failedFaces.length === 0) return [chordNote(change, before, after)];
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

function chordNote(change: number, given: number, made: number): Diagnostic {
  const compared = change < 0 ? "less" : "more";
  const note: DiagnosticOf<"changed-volume"> = {
    code: "changed-volume",
    severity: "information",
    message: sentence(
      `flat triangles on the curved faces enclose ${short(100 * Math.abs(change), 2)} % ${compared} than the solid`,
    ),
    remedy: "Use a smaller size, or second-order elements, which are curved.",
    entities: [],
    data: { given, made },
  };
  return note;
}

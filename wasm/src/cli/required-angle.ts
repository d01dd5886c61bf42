/** The angle of `--require-angle`. */
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { Optimization } from "../generated/constants.js";
import type { MeshReport } from "../mesh/report.js";
import { numberIn } from "./numbers.js";
import { InvalidInput } from "./messages.js";
import { angleText } from "./tables.js";

/** Dihedral angle of the regular tetrahedron, in degrees, rounded down: the limit of any mesh. */
const MAX_REQUIRED_ANGLE = 70;

/** Returns the angle of `--require-angle` in degrees, 0 if it is not given. Throws an InvalidInput. */
export function requiredAngleOf({ requireAngle }: { readonly requireAngle?: string }): number {
  const angle = Number(numberIn(requireAngle) ?? 0);
  if (angle >= 0 && angle <= MAX_REQUIRED_ANGLE) return angle;
  const message = `the required angle is "${requireAngle}"`;
  const remedy = `Use an angle from 0 to ${MAX_REQUIRED_ANGLE} degrees.`;
  throw new InvalidInput("command line", [invalidOption("--require-angle", message, remedy)]);
}

/** Returns an error if the finished mesh has a smaller dihedral angle than required. */
export function requiredAngleError(
  { status, dihedral: { min: angle } }: MeshReport,
  required: number,
  { optimize }: { readonly optimize?: Optimization },
  isRemeshed: boolean,
): Diagnostic[] {
  if (status !== "done" || angle >= required) return [];
  const remedies = [
    ...(isRemeshed ? [] : ["--surface remesh"]),
    ...(optimize === "thorough" ? [] : ["--optimize thorough"]),
    "a surface without needles and narrow gaps",
  ];
  const error: DiagnosticOf<"required-angle"> = {
    code: "required-angle",
    severity: "error",
    message: `The smallest dihedral angle is ${angleText(angle, 2, Math.floor)}, but --require-angle is ${required}°`,
    remedy: `Use ${remedies.join(", or ")}.`,
    entities: [],
    data: { angle, required },
  };
  return [error];
}

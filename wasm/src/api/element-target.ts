/** Runs that reach a number of elements, and what the report says about the number. */
import { plural } from "../base/plural.js";
import { steady } from "../base/same-everywhere.js";
import { short } from "../base/short.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { RunControl } from "../engine/control.js";
import type { ElementCount, MeshReport, MeshResult } from "../mesh/report.js";
import { type CountResult, type FinerPart, meshedToCount, type SearchEnd } from "./element-count.js";
import { WholeProgress } from "./whole-progress.js";

export interface ElementTarget<Made extends MeshResult> {
  /** Wanted number of elements. */
  readonly elements: number;
  /** Number of elements that a run without a factor is expected to make; null if it is not known. */
  readonly expected?: number | null | undefined;
  /** Makes a mesh with all sizes multiplied by the factor. */
  readonly run: (factor: number, control: RunControl, finer?: FinerPart) => Promise<Made>;
  /** Whether `run` can make a finer part. Default false. */
  readonly hasFinerParts?: boolean | undefined;
  /** Whether the triangles of the surface are kept, so that they limit the number. */
  readonly isKept?: boolean | undefined;
}

/**
 * Meshes until the number of elements is within 5 % of the wanted one, or as near as possible, which a warning then says. The
 * report states the number that was asked for.
 */
export async function elementsReached<Made extends MeshResult>(
  target: ElementTarget<Made>,
  control: RunControl,
): Promise<Made> {
  const { elements, expected, run } = target;
  // Several meshes are compared, so none stays in the engine.
  const { onTrace, experiment, inBlocks: _, ...untraced } = control;
  const whole = new WholeProgress(untraced);
  let meshNumber = 0;
  let failure: unknown;
  const found = await meshedToCount<Made | undefined>({
    wanted: elements,
    first: firstFactor(elements, expected ?? elements),
    hasFinerParts: target.hasFinerParts,
    mesh: async (factor, share, finer) => {
      try {
        const made = await run(factor, whole.next(share, { meshNumber: ++meshNumber }), finer);
        const { status, tetrahedra } = made.report;
        return { factor, finer, count: status === "done" ? tetrahedra : undefined, made };
      } catch (error) {
        if (!isLimit(error)) throw error;
        failure ??= error;
        return { factor, count: undefined, made: undefined };
      }
    },
    isEnded: () => control.signal?.aborted === true,
  });
  const { factor, finer } = found.best;
  // A recording has the steps of one run.
  const isRecorded = onTrace !== undefined && found.end !== "failed";
  const made = isRecorded
    ? await run(factor, { ...whole.next(1, { meshNumber: ++meshNumber }), onTrace, experiment }, finer)
    : found.best.made;
  whole.end();
  if (made === undefined) throw failure;
  return reported(made, found, target, whole.seconds);
}

/** Powers of the number over the factor that are assumed for the first run, towards fewer and towards more elements. */
const FEWER_POWER = 2.2;
const MORE_POWER = 2.8;
/** A first run with far more elements than expected without a factor makes fewer than all: its factor may be wrong, and it takes long. */
const MANY = 50_000;
const FAR = 10;
const FIRST_PART = 6;

function firstFactor(elements: number, expected: number): number {
  let ratio = elements / Math.max(1, expected);
  if (elements > MANY && ratio > FAR) ratio /= FIRST_PART;
  return steady(ratio ** (-1 / (ratio > 1 ? MORE_POWER : FEWER_POWER)));
}

/** Sizes that ask for too many elements, or for more memory than there is. */
function isLimit(error: unknown): boolean {
  if (!(error instanceof MesherError)) return false;
  return (
    error.code === "out-of-memory" ||
    (error.code === "invalid-input" &&
      error.data.diagnostics.some(({ code }) => code === "too-many-elements"))
  );
}

function reported<Made extends MeshResult>(
  made: Made,
  { end, runs, best, reachable = [] }: CountResult<unknown>,
  { elements, expected, isKept = false }: ElementTarget<Made>,
  seconds: number,
): Made {
  const { report } = made;
  const reached = report.tetrahedra;
  const counted: ElementCount = { asked: elements, reached, sizeFactor: best.factor, runs };
  const found = [...missed(counted, end, { isKept, reachable }), ...tooFew(report, counted, expected)];
  const all = report.status === "done" ? [...report.diagnostics, ...found] : report.diagnostics;
  return {
    ...made,
    report: {
      ...report,
      seconds: { ...report.seconds, total: seconds },
      elements: counted,
      diagnostics: all,
    },
  };
}

/** Smallest dihedral angle, in degrees, and mean radius ratio below which a mesh is unfit as a whole. */
const UNFIT_ANGLE = 10;
const UNFIT_RATIO = 0.6;
/** Number that is expected without a factor / number that was asked for, above which the number is to blame for shapes. */
const TOO_FEW = 1.5;

/** Returns a warning if elements are poor because there are so few, as in thin walls, with the number that suffices. */
function tooFew(
  { tetrahedra, dihedral, radiusRatio }: MeshReport,
  { asked, sizeFactor }: ElementCount,
  expected: number | null | undefined,
): Diagnostic[] {
  const isUnfit = dihedral.min < UNFIT_ANGLE || radiusRatio.mean < UNFIT_RATIO;
  if (!isUnfit || sizeFactor <= 1 || expected == null || expected < TOO_FEW * asked) return [];
  const good = Number(expected.toPrecision(2));
  const message = `${plural(tetrahedra, "element")} are too few for good shapes, as in thin walls: the smallest dihedral angle is ${short(dihedral.min, 2)}°, and the mean radius ratio ${short(radiusRatio.mean, 2)}`;
  const remedy = `Ask for about ${good} elements, which the automatic sizes lead to, or compute thin walls with shell elements.`;
  return [packageDiagnostic("element-count", message, remedy, "warning")];
}

/** Returns a warning if the number was not reached. */
function missed(
  { asked, reached }: ElementCount,
  end: SearchEnd,
  { isKept, reachable }: { readonly isKept: boolean; readonly reachable: readonly number[] },
): Diagnostic[] {
  if (end === "reached" || end === "failed") return [];
  const [why, remedy] = reasons(end, isKept, reached, reachable);
  const message = `${plural(asked, "element")} asked for, ${reached} reached: ${why}`;
  return [packageDiagnostic("element-count", message, remedy, "warning")];
}

const REMESH = 'Remesh the surface (`surface: "remesh"` or `remeshSurface()`)';

function reasons(
  end: Exclude<SearchEnd, "reached" | "failed">,
  isKept: boolean,
  reached: number,
  reachable: readonly number[],
): [string, string] {
  switch (end) {
    case "least":
      return isKept
        ? [
            `about ${reached} are the fewest, because the triangles of the surface are kept`,
            `${REMESH}, so that its triangles get larger.`,
          ]
        : [
            `about ${reached} are the fewest that this shape permits: its sharp edges, narrow faces and thin walls need them`,
            "Drop details of the shape, or accept this number.",
          ];
    case "most":
      return isKept
        ? [
            `about ${reached} are the most, because the triangles of the surface are kept, or because memory ends`,
            `${REMESH}, so that its triangles get smaller.`,
          ]
        : [
            `about ${reached} are the most that other given sizes or the limits of memory permit`,
            "Ask for fewer, or omit limits of sizes.",
          ];
    case "nearest":
      return [
        `the number changes in jumps with the sizes, for example where a thin wall gets a further layer, or edges and faces one element more${reachable.length > 1 ? `; the nearest numbers found are ${reachable.join(" and ")}` : ""}`,
        "Ask for one of these numbers, or accept this one.",
      ];
  }
}

/** Why a file, or a value said to be a project, could not be read. */
import { printable } from "../diagnostics/package-diagnostic.js";

/**
 * - `invalid-argument`: an argument is not what it should be, such as a source of bytes, or a file name is missing.
 * - `unknown-format`: the file's name tells no format that can be read, or written, as this.
 * - `empty-file`: it has no byte.
 * - `malformed-file`: its content does not follow its format, or goes beyond what is read of it; `line` or `offset`
 *   tells where.
 * - `too-large-file`: it has more points or elements than can be numbered, or than there is memory for.
 * - `missing-file`: it says so little without another file beside it, which was not there.
 * - `no-triangles`, `no-tetrahedra`: it holds none.
 * - `invalid-sizes`: the numbers at its nodes are no element sizes.
 * - `not-a-project`: neither format nor structure are a project's.
 * - `later-version`: a project of a later version of this program.
 * - `invalid-project`: a project with a value that cannot be; `path` tells where.
 */
export type ReadCode =
  | "invalid-argument"
  | "unknown-format"
  | "empty-file"
  | "malformed-file"
  | "too-large-file"
  | "missing-file"
  | "no-triangles"
  | "no-tetrahedra"
  | "invalid-sizes"
  | "not-a-project"
  | "later-version"
  | "invalid-project";

/** One thing that is wrong. */
export interface ReadProblem {
  readonly code: ReadCode;
  /** One sentence: what is wrong, and where in the file. */
  readonly message: string;
  /** One sentence: what to do about it. */
  readonly remedy: string;
  /** Of formats that have several files it may be one beside that which was given. */
  readonly fileName?: string | undefined;
  /** Where in a project, e.g. `lines[3].points[1]`. */
  readonly path?: string | undefined;
  /** Where in a text file, from 1. */
  readonly line?: number | undefined;
  /** Where in a binary file, in bytes from 0. */
  readonly offset?: number | undefined;
}

/** Expected failure is a value. At least one problem where `success` is false. */
export type ReadResult<T> =
  | { readonly success: true; readonly value: T }
  | { readonly success: false; readonly problems: readonly [ReadProblem, ...ReadProblem[]] };

/** Raised inside a reader and turned into a result at its entry; never seen by callers. */
export class ReadFailure extends Error {
  readonly problem: ReadProblem;

  constructor(problem: Omit<ReadProblem, "code"> & { readonly code?: ReadCode }) {
    super(problem.message);
    this.problem = { code: "malformed-file", ...problem, message: printable(problem.message) };
  }
}

/** A failure in a file of this name, unless it tells of another; anything else as it is. */
export function failureIn(fileName: string, failure: unknown): unknown {
  if (!(failure instanceof ReadFailure)) return failure;
  return new ReadFailure({ fileName, ...failure.problem });
}

/** Of a file with more coordinates, or corners, than 32-bit positions can tell apart. */
export function tooManyNumbers(most: number): ReadFailure {
  const [threes, fours] = [Math.floor(most / 3), Math.floor(most / 4)];
  return new ReadFailure({
    code: "too-large-file",
    message: `the file has more than ${threes} points or triangles, or ${fours} tetrahedra, the most that can be numbered`,
    remedy: "Cut it into parts.",
  });
}

/** The failure of a file whose arrays the machine has no memory for, where it is one. */
export function asTooLarge(failure: unknown): unknown {
  if (!(failure instanceof RangeError && /alloc|array length|buffer|maximum size/i.test(failure.message))) {
    return failure;
  }
  return new ReadFailure({
    code: "too-large-file",
    message: "the file's points and elements do not fit into the memory that there is",
    remedy: "Give a smaller mesh, or the parts of it one by one: a point takes 24 bytes, a triangle 16.",
  });
}

/** Where something was read: `line` in text, else `offset`. */
export type FilePlace = Pick<ReadProblem, "line" | "offset">;

/** A failure at a place, which its message begins with. */
export function failureAt(place: FilePlace, message: string, remedy: string): ReadFailure {
  const words = place.line === undefined ? `byte ${place.offset ?? 0}` : `line ${place.line}`;
  return new ReadFailure({ message: `${words}: ${message}`, remedy, ...place });
}

/** Runs a reader; a ReadFailure becomes a result, anything else is our own mistake and passes through. */
export function readSafely<T>(read: () => T): ReadResult<T> {
  try {
    return { success: true, value: read() };
  } catch (failure) {
    if (failure instanceof ReadFailure) return { success: false, problems: [failure.problem] };
    throw failure;
  }
}

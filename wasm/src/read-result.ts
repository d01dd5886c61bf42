/** Why a file, or a value said to be a project, could not be read. */
export interface ReadProblem {
  /** One sentence: what is wrong. */
  readonly message: string;
  /** One sentence: what to do about it. */
  readonly remedy: string;
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
  constructor(readonly problem: ReadProblem) {
    super(problem.message);
  }
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

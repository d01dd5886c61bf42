/** Messages and exit codes of the command line. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { diagnosticLines } from "../diagnostics/lines.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { packageDiagnostic, printable, readDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { ReadError } from "../diagnostics/read-error.js";
import { asTypedDiagnostic } from "./command-line-words.js";
import { FileError, WriteError } from "./files.js";

/** Shells report 141 for a program that writes to a pipe without a reader: 128 plus the number of the signal. */
export const ExitCode = { meshed: 0, notCompleted: 1, invalidInput: 2, closedPipe: 141 } as const;

/** Thrown for invalid input; becomes messages, a report, and exit code 2. */
export class InvalidInput extends Error {
  constructor(
    /** Subject of the messages: a file or an option. */
    readonly subject: string,
    readonly diagnostics: readonly Diagnostic[],
  ) {
    super(subject);
  }
}

/** Thrown if the solver of an adaptation fails; the command then ends without a result. */
export class SolverFailure extends InvalidInput {
  constructor(diagnostics: readonly Diagnostic[]) {
    super("solver", diagnostics);
  }
}

/** Returns a failure caused by the input, with its diagnostics and subject; undefined for other failures. */
export function asInvalidInput(failure: unknown, input: string): InvalidInput | undefined {
  if (failure instanceof InvalidInput) return failure;
  if (failure instanceof FileError) {
    const { file, message, remedy } = failure;
    return new InvalidInput(file, [packageDiagnostic("unreadable-input", message, remedy)]);
  }
  if (failure instanceof MesherError && failure.code === "invalid-input") {
    return new InvalidInput(input, failure.data.diagnostics);
  }
  return undefined;
}

/** Returns a failure of the engine as a diagnostic; undefined for other failures. */
export function asEngineFailure(failure: unknown): Diagnostic | undefined {
  if (!(failure instanceof MesherError)) return undefined;
  const { code, message } = failure;
  const isEngine = code === "out-of-memory" || code === "engine-not-loaded" || code === "engine-failed";
  return isEngine ? packageDiagnostic(code, message.replace(/\.$/, ""), "") : undefined;
}

/** Outcome of a command that wrote nothing. */
export interface FailedOutcome {
  readonly output: null;
  readonly diagnostics: readonly Diagnostic[];
  readonly exitCode: number;
}

/**
 * Prints invalid input, a failure of the engine, or that the command was cancelled; returns the outcome. Rethrows all
 * other failures, which are bugs. `printInvalid` prints the diagnostics of invalid input.
 */
export function failedOutcome(
  failure: unknown,
  input: string,
  printInvalid = (subject: string, diagnostics: readonly Diagnostic[]): void =>
    printDiagnostics(subject, diagnostics, { isQuiet: true }),
): FailedOutcome {
  if (failure instanceof MesherError && failure.code === "cancelled") {
    print(`${input}: cancelled, not written`);
    return { output: null, diagnostics: [], exitCode: ExitCode.notCompleted };
  }
  const engine = asEngineFailure(failure);
  if (engine !== undefined) {
    printDiagnostics(input, [engine], { isQuiet: true });
    return { output: null, diagnostics: [engine], exitCode: ExitCode.notCompleted };
  }
  const invalid = asInvalidInput(failure, input);
  if (invalid === undefined) throw failure;
  printInvalid(invalid.subject, invalid.diagnostics);
  const isIncomplete = failure instanceof WriteError || failure instanceof SolverFailure;
  const exitCode = isIncomplete ? ExitCode.notCompleted : ExitCode.invalidInput;
  return { output: null, diagnostics: invalid.diagnostics, exitCode };
}

/** The same for commands without a report; returns the exit code. */
export function reportFailure(failure: unknown, input: string): number {
  return failedOutcome(failure, input).exitCode;
}

/** `readAs`: name of the given file. An error in another file next to it names that file. */
export function unreadable(error: ReadError, readAs?: string): Diagnostic {
  const { message, line, fileName } = error;
  const other = fileName === undefined || readAs === undefined || fileName === readAs ? "" : `${fileName}: `;
  const location = line === undefined || message.startsWith("line ") ? "" : `line ${line}: `;
  return readDiagnostic({ ...error, message: `${other}${location}${message}` });
}

interface PrintOptions {
  /** Whether to print errors only. */
  readonly isQuiet: boolean;
  readonly perCode?: number | undefined;
  /** Receives each line. By default, the line is printed to standard error. */
  readonly onLine?: (line: string) => void;
}

/** Prints one line per diagnostic, grouped by code in the order in which the codes first appear. */
export function printDiagnostics(
  subject: string,
  diagnostics: readonly Diagnostic[],
  options: PrintOptions,
): void {
  const { isQuiet, perCode, onLine = print } = options;
  const reported = diagnostics
    .filter(({ severity }) => !isQuiet || severity === "error")
    .map((found) => asTypedDiagnostic(found));
  for (const { severity, text } of diagnosticLines(reported, perCode)) {
    onLine(`${WORDS[severity]}: ${subject}: ${text}`);
  }
}

/** Diagnostics per piece of JSON: a million of them would exceed the longest string. */
const PIECE = 1000;

/** Yields the text of JSON.stringify in pieces, with the diagnostics last. */
export function* jsonPieces<Report extends { readonly diagnostics: readonly Diagnostic[] }>({
  diagnostics,
  ...rest
}: Report): Generator<string, void> {
  const empty = JSON.stringify({ ...rest, diagnostics: [] }, null, 2);
  if (diagnostics.length === 0) {
    yield `${empty}\n`;
    return;
  }
  yield empty.slice(0, -"]\n}".length);
  for (let begin = 0; begin < diagnostics.length; begin += PIECE) {
    const list = JSON.stringify(diagnostics.slice(begin, begin + PIECE).map(asTypedDiagnostic), null, 2);
    yield `${begin === 0 ? "" : ","}${list.slice(1, -"\n]".length).replaceAll("\n", "\n  ")}`;
  }
  yield "\n  ]\n}\n";
}

const WORDS: Readonly<Record<Diagnostic["severity"], string>> = {
  error: "error",
  warning: "warning",
  information: "note",
};

export function print(line: string): void {
  process.stderr.write(`tetrafront: ${printable(line)}\n`);
}

/** What the command line says, and how its commands end. */
import { FileProblem } from "./files.js";
import { packageDiagnostic, printable, readDiagnostic } from "../diagnostics/package-diagnostic.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import type { ReadProblem } from "../formats/read-result.js";
import type { Diagnostic } from "../api/types.js";

/** 141 is what shells report of programs that write to a pipe which nobody reads: 128 and the signal's number. */
export const ExitCode = { meshed: 0, notCompleted: 1, badInput: 2, closedPipe: 141 } as const;

/** Raised where the input is bad; becomes messages, a report, and exit code 2. */
export class BadInput extends Error {
  constructor(
    /** What the messages are about: a file or an option. */
    readonly subject: string,
    readonly diagnostics: readonly Diagnostic[],
  ) {
    super(subject);
  }
}

/** Input that cannot be used, as diagnostics and what they are about; undefined for other failures. */
export function asBadInput(failure: unknown, input: string): BadInput | undefined {
  if (failure instanceof BadInput) return failure;
  if (failure instanceof FileProblem) {
    const { file, message, remedy } = failure;
    return new BadInput(file, [packageDiagnostic("unreadable-input", message, remedy)]);
  }
  if (failure instanceof MesherError && failure.code === "invalid-input") {
    return new BadInput(input, failure.data.diagnostics);
  }
  return undefined;
}

/** What the engine could not do, as a diagnostic; undefined for other failures. */
export function asEngineFailure(failure: unknown): Diagnostic | undefined {
  if (!(failure instanceof MesherError)) return undefined;
  const { code, message } = failure;
  const isEngine = code === "out-of-memory" || code === "engine-not-loaded" || code === "engine-failed";
  return isEngine ? packageDiagnostic(code, message.replace(/\.$/, ""), "") : undefined;
}

/** Tells of bad input, or of what the engine could not do; the exit code. Our own mistakes pass through. */
export function toldFailure(failure: unknown, input: string): number {
  const engine = asEngineFailure(failure);
  const bad = engine === undefined ? asBadInput(failure, input) : new BadInput(input, [engine]);
  if (bad === undefined) throw failure;
  tell(bad.subject, bad.diagnostics, { isQuiet: true });
  return engine === undefined ? ExitCode.badInput : ExitCode.notCompleted;
}

/** `readAs`: the name of the file that was given; a problem of another beside it names that. */
export function unreadable(problem: ReadProblem, readAs?: string): Diagnostic {
  const { message, line, fileName } = problem;
  const other = fileName === undefined || readAs === undefined || fileName === readAs ? "" : `${fileName}: `;
  const place = line === undefined || message.startsWith("line ") ? "" : `line ${line}: `;
  return readDiagnostic({ ...problem, message: `${other}${place}${message}` });
}

/** Of one code no more than these are told: more of the same teach nothing and hide the others. */
const TOLD_PER_CODE = 5;

interface TellOptions {
  /** Leaves the errors. */
  readonly isQuiet: boolean;
  readonly perCode?: number;
}

/** One line per diagnostic, those of one code together, in the order in which codes first appear. */
export function tell(subject: string, diagnostics: readonly Diagnostic[], options: TellOptions): void {
  const { isQuiet, perCode = TOLD_PER_CODE } = options;
  const told = diagnostics.filter(({ severity }) => !isQuiet || severity === "error");
  for (const group of byKind(told)) tellGroup(subject, group, perCode);
}

/** Those of one severity and code together, in the order in which these first appear. */
function byKind(diagnostics: readonly Diagnostic[]): Iterable<readonly Diagnostic[]> {
  const groups = new Map<string, Diagnostic[]>();
  for (const diagnostic of diagnostics) {
    const key = `${diagnostic.severity} ${diagnostic.code}`;
    const group = groups.get(key);
    if (group === undefined) groups.set(key, [diagnostic]);
    else group.push(diagnostic);
  }
  return groups.values();
}

/** How many findings of this severity there are, with those that are not told one by one. */
export function countOf(diagnostics: readonly Diagnostic[], wanted: Diagnostic["severity"]): number {
  const found = diagnostics.filter(({ severity }) => severity === wanted);
  return [...byKind(found)].reduce((sum, group) => sum + allOfAKind(group), 0);
}

/**
 * How many findings of one kind there are in all, of which these are told one by one: of a given surface each says so,
 * of a drawing it counts those at its own lines and patches.
 */
function allOfAKind(group: readonly Diagnostic[]): number {
  const [first] = group;
  if (first === undefined || !isOfSurface(first) || !("count" in first.data)) return group.length;
  return Math.max(group.length, first.data.count ?? 0);
}

/** Whether it is about a given surface, whose triangles and nodes have no names. */
function isOfSurface({ entities }: Diagnostic): boolean {
  return entities.every(({ kind }) => kind === "triangle" || kind === "surface-node");
}

/** What has neither name nor place and reads the same but for its numbers is one line with a count. */
function tellGroup(subject: string, group: readonly Diagnostic[], perCode: number): void {
  const lines = new Map<string, { readonly line: string; count: number }>();
  for (const diagnostic of group) {
    const { severity, code, message, remedy, position } = diagnostic;
    const line = `${WORDS[severity]}: ${subject}: ${message}. ${remedy}`.trimEnd();
    // Coordinates that cannot be computed with are no place either.
    const isAlike = isOfSurface(diagnostic) && (position === undefined || code === "not-finite");
    const key = isAlike ? message.replace(/[-+\d.e]*\d/g, "#") : line;
    const known = lines.get(key);
    if (known === undefined) lines.set(key, { line, count: 1 });
    else known.count++;
  }
  let rest = allOfAKind(group);
  for (const { line, count } of [...lines.values()].slice(0, perCode)) {
    say(count === 1 ? line : `${line} (and ${count - 1} more like it)`);
    rest -= count;
  }
  const [first] = group;
  if (first !== undefined && rest > 0) {
    say(`${WORDS[first.severity]}: ${subject}: and ${rest} more of the kind "${first.code}".`);
  }
}

/** So many diagnostics are one piece of JSON: a million of them would be too long for one string. */
const PIECE = 1000;

/** As JSON.stringify has it, in lines, the diagnostics last. */
export function* jsonPieces<Told extends { readonly diagnostics: readonly Diagnostic[] }>({
  diagnostics,
  ...rest
}: Told): Generator<string, void> {
  const empty = JSON.stringify({ ...rest, diagnostics: [] }, null, 2);
  if (diagnostics.length === 0) {
    yield `${empty}\n`;
    return;
  }
  yield empty.slice(0, -"]\n}".length);
  for (let begin = 0; begin < diagnostics.length; begin += PIECE) {
    const list = JSON.stringify(diagnostics.slice(begin, begin + PIECE), null, 2);
    yield `${begin === 0 ? "" : ","}${list.slice(1, -"\n]".length).replaceAll("\n", "\n  ")}`;
  }
  yield "\n  ]\n}\n";
}

const WORDS: Readonly<Record<Diagnostic["severity"], string>> = {
  error: "error",
  warning: "warning",
  information: "note",
};

export function say(line: string): void {
  process.stderr.write(`tetrafront: ${printable(line)}\n`);
}

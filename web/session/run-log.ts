/** The log of a run: what it did, in sentences. */
import type { Diagnostic, MeshResult } from "tetrafront";
import { logStrings, remedyInApp } from "../strings";
import { formatCount } from "../strings/format";

export type LogLevel = "information" | "success" | "warning" | "error";

export interface LogLine {
  readonly id: number;
  /** Seconds since the run began. */
  readonly seconds: number;
  readonly level: LogLevel;
  readonly text: string;
}

/** What was done to the model before a run, or what the user should know of it: a warning is a problem of the run too. */
export interface RunNote {
  readonly level: "information" | "warning";
  readonly text: string;
  readonly remedy?: string;
}

const maxLines = 400;

/** Returns the log with one more line; the oldest are dropped. */
export function withLine(log: readonly LogLine[], line: Omit<LogLine, "id">): readonly LogLine[] {
  return [...log, { id: (log.at(-1)?.id ?? 0) + 1, ...line }].slice(-maxLines);
}

/** Adds a full stop, unless the text ends with a punctuation mark. */
const sentence = (text: string): string => (/[.!?…]$/.test(text) ? text : `${text}.`);

export const noteText = ({ text, remedy }: RunNote): string =>
  remedy === undefined ? text : `${sentence(text)} ${remedy}`;

export const diagnosticText = (diagnostic: Diagnostic): string =>
  [diagnostic.message, remedyInApp(diagnostic)]
    .filter((part) => part !== "")
    .map(sentence)
    .join(" ");

/** What a run has made. */
interface Made {
  readonly result: MeshResult;
  readonly expectedTetrahedra: number;
}

export const sizeOf = ({ report }: MeshResult): string =>
  logStrings.size(formatCount(report.tetrahedra), formatCount(report.nodes));

/** Returns how a run has ended. */
export function summary({ result, expectedTetrahedra }: Made): string {
  const { report } = result;
  const size = sizeOf(result);
  const seconds = `${report.seconds.total.toFixed(2)} s`;
  switch (report.status) {
    case "done":
      return logStrings.done(size, seconds, report.fingerprint);
    case "cancelled":
      return logStrings.cancelled(
        size,
        seconds,
        result.front.length > 0 ? aboutCount(expectedTetrahedra) : null,
      );
    case "stalled":
      return logStrings.stalled(size, seconds);
    case "invalid-input":
      return logStrings.invalid;
  }
}

/** Returns the expected number of tetrahedra as it is shown; null if none is known. */
const aboutCount = (expected: number): string | null =>
  expected > 0 ? formatCount(Number(expected.toPrecision(2))) : null;

/** Returns how far the run came whose mesh is shown, if it was cancelled before its front closed; null for any other mesh. */
export function cancelledText({
  mesh,
  outcome,
}: {
  readonly mesh: MeshResult | null;
  readonly outcome: Made | null;
}): string | null {
  if (mesh?.report.status !== "cancelled" || mesh.front.length === 0) return null;
  const expected = outcome?.result === mesh ? outcome.expectedTetrahedra : 0;
  return logStrings.cancelledAt(formatCount(mesh.report.tetrahedra), aboutCount(expected));
}

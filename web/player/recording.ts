import {
  recordTrace,
  type Mesher,
  type MeshReport,
  type PreparedBody,
  type Project,
  type RunControl,
  type Trace,
} from "tetrafront";
import { engineInput } from "../document/engine-input";
import { failureText } from "../session/failure-text";
import { remedyInApp } from "../strings";

/** Returns the triangles of bodies that are already made. */
export type PreparedOf = (project: Project) => readonly PreparedBody[];

export interface FailedRecording {
  readonly kind: "failed";
  readonly reasons: readonly string[];
}

/** A recorded front, read. */
export type Recorded = (RecordedFile & { readonly trace: Trace }) | FailedRecording;

export interface RecordedFile {
  readonly kind: "recorded";
  readonly file: Uint8Array<ArrayBuffer>;
  /** The mesh of the front, before any optimization. */
  readonly report: MeshReport;
}

/**
 * Meshes a project as Generate mesh does, but without the optimization, which is not part of a trace. Resolves in
 * any case; a recording that was stopped has the steps made until then.
 */
export async function recordProject(
  mesher: Mesher,
  project: Project,
  preparedOf: PreparedOf,
  control: RunControl,
): Promise<RecordedFile | FailedRecording> {
  const [input, options] = engineInput(project);
  const preparedBodies = preparedOf(project);
  try {
    const { result, trace: file } = await recordTrace(
      mesher,
      input,
      { ...options, ...(preparedBodies.length > 0 && { preparedBodies }), optimization: "none" },
      control,
    );
    if (!file) {
      const reasons = result.report.diagnostics.map(
        (diagnostic) => `${diagnostic.message}. ${remedyInApp(diagnostic)}`,
      );
      return { kind: "failed", reasons };
    }
    return { kind: "recorded", file, report: result.report };
  } catch (error) {
    return { kind: "failed", reasons: [failureText(error)] };
  }
}

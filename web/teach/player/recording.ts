import type { FrontOrder, Mesher, MeshReport, PreparedBody, RunControl } from "tetrafront";
import type { Project } from "tetrafront/project";
import type { FrontExperiment, Trace } from "tetrafront/trace";
import { engineInput } from "../../document/engine-input";
import { failureText } from "../../session/failure-text";
import { remedyInApp } from "../../strings";

/** Returns the triangles of bodies that are already made. */
export type PreparedOf = (project: Project) => readonly PreparedBody[];

/** What is recorded instead of what the model says. */
export interface RecordingChoices {
  readonly order?: FrontOrder | undefined;
  /** Changes to the rules of the front. */
  readonly experiment?: FrontExperiment | undefined;
  /** False skips cheap tests for crossings. */
  readonly filters?: boolean | undefined;
  /** Whether the optimizer's sweeps are recorded too, which takes longer. Default false. */
  readonly optimizes?: boolean | undefined;
}

export interface FailedRecording {
  readonly kind: "failed";
  readonly reasons: readonly string[];
  /** Whether the user stopped it before there was anything to show. */
  readonly isStopped: boolean;
}

/** A recorded front, read. */
export type Recorded = (RecordedFile & { readonly trace: Trace }) | FailedRecording;

export interface RecordedFile {
  readonly kind: "recorded";
  readonly file: Uint8Array<ArrayBuffer>;
  /** Report on the mesh of the front; on the optimized mesh if the sweeps are recorded. */
  readonly report: MeshReport;
  /** Whether the user stopped it: the file has the steps until then. */
  readonly isStopped: boolean;
}

/**
 * Meshes a project as Generate mesh does, or with other rules; without the optimization unless it is asked for. Resolves in
 * any case; a recording that was stopped has the steps made until then.
 */
export async function recordProject(
  mesher: Mesher,
  project: Project,
  preparedOf: PreparedOf,
  { order, experiment, filters, optimizes = false }: RecordingChoices,
  control: RunControl,
): Promise<RecordedFile | FailedRecording> {
  const [input, options] = engineInput(project);
  const preparedBodies = preparedOf(project);
  try {
    const { recordTrace } = await import("tetrafront/trace");
    const { result, trace: file } = await recordTrace(
      mesher,
      input,
      {
        ...options,
        ...(preparedBodies.length > 0 && { preparedBodies }),
        ...(order && { order }),
        ...(filters !== undefined && { filters }),
        ...(!optimizes && { optimization: "none" }),
        experiment,
      },
      control,
    );
    if (!file) {
      const reasons = result.report.diagnostics.map(
        (diagnostic) => `${diagnostic.message}. ${remedyInApp(diagnostic)}`,
      );
      return { kind: "failed", reasons, isStopped: result.report.status === "cancelled" };
    }
    const { report } = result;
    return { kind: "recorded", file, report, isStopped: report.status === "cancelled" };
  } catch (error) {
    return { kind: "failed", reasons: [failureText(error)], isStopped: false };
  }
}

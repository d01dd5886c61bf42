/** Recording of a run as a trace file. */
import { checkArgument } from "../calls/argument-checks.js";
import type { RunControl } from "../engine/control.js";
import { type FrontOrder, MESH_DEFAULTS } from "../generated/constants.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import type { MeshResult, MeshStatus } from "../mesh/report.js";
import type { Project } from "../project/project-types.js";
import { experimentSchema, type FrontExperiment } from "../trace/experiment.js";
import type { TraceStatus } from "../trace/layout.js";
import { traceFile } from "../trace/trace-file.js";
import type { Mesher } from "./mesher-interface.js";
import type { MeshOptions, ProjectMeshOptions } from "./option-types.js";

/** A recorded run. */
export interface RecordedMesh {
  readonly result: MeshResult;
  /** The trace as a file (docs/TRACE.md), for `readTrace`; absent if the front of the volume never began. */
  readonly trace?: Uint8Array<ArrayBuffer> | undefined;
}

/** Options of a recorded run: those of `meshProject` or `fillSurface`. */
export type RecordingOptions = (MeshOptions | ProjectMeshOptions) & {
  /** Name in the trace; by default that of the project, else "surface". */
  readonly name?: string | undefined;
  /** Changes to the rules of the front; the mesh is then another one. */
  readonly experiment?: FrontExperiment | undefined;
};

/**
 * Meshes a project or fills a surface, and records every step of the lines, of the patches and of the front in the
 * volume, and every sweep of the optimizer. The mesh is that of `meshProject` or `fillSurface`, bit for bit, unless an
 * `experiment` changes the rules. A step takes about 40 bytes, in a stretched size field 60; the sweeps over a mesh of up to
 * 100 000 elements, with which every mesh between them can be shown, about 40 bytes per element. Ends and
 * rejects as these calls do.
 *
 *     const { trace } = await recordTrace(mesher, project, { optimization: "none" });
 *     const read = trace && readTrace(trace);
 */
export async function recordTrace(
  mesher: Mesher,
  input: Project | SurfaceInput,
  { name, experiment, ...options }: RecordingOptions = {},
  control: RunControl = {},
): Promise<RecordedMesh> {
  if (experiment) checkArgument("experiment", experiment, experimentSchema);
  const events: Uint8Array[] = [];
  const recording: RunControl = {
    ...control,
    experiment,
    onTrace: (piece) => {
      events.push(piece);
      return control.onTrace?.(piece);
    },
  };
  const result = isSurface(input)
    ? await mesher.fillSurface(input, options, recording)
    : await mesher.meshProject(input, options, recording);
  const project = isSurface(input) ? undefined : input;
  const order = options.order ?? project?.meshing?.order;
  const run = { name: name ?? project?.name ?? "surface", order, experiment };
  return { result, trace: recordedTrace(result, events, run) };
}

const isSurface = (input: Project | SurfaceInput): input is SurfaceInput => ArrayBuffer.isView(input.points);

/** What the header of a trace says about its run. */
interface RecordedRun {
  readonly name: string;
  readonly order?: FrontOrder | undefined;
  readonly experiment?: FrontExperiment | undefined;
}

/** Returns the trace of a run with `onTrace` as a file; undefined if the front of the volume never began. */
export function recordedTrace(
  { recording, report, mesh, surfaceNodes }: MeshResult,
  events: readonly Uint8Array[],
  { name, order = MESH_DEFAULTS.order, experiment }: RecordedRun,
): Uint8Array<ArrayBuffer> | undefined {
  if (recording === undefined || recording.steps === 0) return undefined;
  const header = {
    name,
    nodes: surfaceNodes,
    steps: recording.steps,
    order,
    status: frontStatus(report.status, recording.fingerprint),
    fingerprint: recording.fingerprint,
    experiment,
  } as const;
  return traceFile(header, mesh.points.subarray(0, 3 * surfaceNodes), events);
}

function frontStatus(status: MeshStatus, fingerprint: string): TraceStatus {
  // A front that exceeds the limit of elements ends as invalid input.
  if (status === "invalid-input") return "stalled";
  // Cancelled while the mesh was optimized: the front has a fingerprint.
  return status === "cancelled" && /[^0]/.test(fingerprint) ? "done" : status;
}

/**
 * Recorded runs, to show and explain how the front advances: `recordTrace()` records one, `loadTrace()` reads a file
 * (docs/TRACE.md).
 *
 *     import { loadTrace, recordTrace } from "tetrafront/trace";
 */
export { loadTrace, readTrace, type LoadTraceOptions } from "./trace/read-trace.js";
export type { Trace, TraceSummary } from "./trace/trace.js";
export type { SweptMesh, TracedOptimization } from "./trace/optimization.js";
export type { OptimizationSummary, SweepMeasures, TracedSweep } from "./trace/sweep-events.js";
export type { TraceHeader } from "./trace/header.js";
export { FRONT_SEARCHES, type FrontExperiment, type FrontSearch } from "./trace/experiment.js";
export type { LinesSummary, PatchesSummary, SurfaceTrace, TriedCandidates } from "./trace/surface-trace.js";
export type { PlaneSample, Triple } from "./trace/surface-events.js";
export type {
  DivideStep,
  EdgeCandidate,
  EdgeStep,
  HalveStep,
  ImprovedPatch,
  ImproveStep,
  PatchStep,
  PlanarFront,
  PlanePosition,
  StationStep,
  SurfaceStep,
  TracedDivision,
} from "./trace/surface-steps.js";
export type { TracedFront } from "./trace/replay.js";
export type { TracedMesh } from "./trace/final-mesh.js";
export type { Lifetimes, TraceElements, TraceFaces, TraceNodes, TraceSteps } from "./trace/trace-columns.js";
export type {
  AdvanceStep,
  RecoveryStep,
  StepChanges,
  TracedCandidate,
  TracePosition,
  TraceStep,
} from "./trace/trace-step.js";
export {
  EDGE_REFUSALS,
  type EdgeRefusal,
  FRONT_CHANGES,
  type FrontChange,
  PLANAR_ENDS,
  type PlanarEnd,
  type Refusal,
  REFUSALS,
  STATION_ENDS,
  SWEEP_KINDS,
  type SweepKind,
  type StationEnd,
  TRACE_STATUSES,
  type TraceStatus,
} from "./trace/layout.js";
export { recordTrace, type RecordedMesh, type RecordingOptions } from "./api/trace-recording.js";
export { fillPlane, loadPlaneFront, type PlaneFront } from "./api/plane-filling.js";
export type {
  FilledPlane,
  FillPlaneOptions,
  FillPlaneResult,
  PlaneErrorCode,
  PlaneExperiment,
  PlaneLoop,
  PlaneMesh,
  PlaneNode,
  PlaneSegment,
  PlaneSizes,
  PlaneSource,
  UnfilledPlane,
} from "./api/plane-types.js";
export type { FrontRecording } from "./mesh/report.js";

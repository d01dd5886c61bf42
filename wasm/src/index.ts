/**
 * Tetrafront: tetrahedral meshes by the advancing-front method (Löhner & Parikh 1988).
 *
 *     import { createMesher, fileMeshOf, readSurface, writeMesh } from "tetrafront";
 */
export {
  type CheckedOption,
  type CoverShape,
  ENGINE_CODES,
  type EngineCode,
  type EngineNumbers,
  type EngineStatus,
  type EntityKind,
  FRONT_ORDERS,
  type FrontOrder,
  INNER_SHELLS,
  type InnerShells,
  type LineType,
  MESH_DEFAULTS,
  NO_ORIGIN,
  NO_REGION,
  type Optimization,
  OPTIMIZATIONS,
  type PatchType,
  type Phase,
  type PoorReason,
  PROPOSAL_DEFAULTS,
  REMESH_DEFAULTS,
  type Severity,
  SOURCE_GROWTH,
  type SourceType,
} from "./generated/constants.js";
export type { Counted, DiagnosticData, DiagnosticNumbers, NoData, ReadLocation } from "./diagnostics/data.js";
export type { DiagnosticCode, PackageCode } from "./diagnostics/codes.js";
export type { ErrorCode } from "./diagnostics/mesher-error.js";
export type { ByteSource } from "./formats/byte-source.js";
export type {
  Contents,
  FileParts,
  FileFormat,
  FormatCode,
  MeshReader,
  MeshWriter,
  Note,
  OpenOther,
  ReadContext,
  WrittenFile,
} from "./formats/file-format.js";
export type { Part } from "./formats/bytes.js";
export type { MidNodes, WrittenMesh } from "./formats/second-order.js";
export { setCadLibrary } from "./cad/cad-library.js";
export type { CadLibrary } from "./cad/protocol.js";
export { extensionsFor, FILE_FORMATS, formatOf } from "./formats/file-formats.js";
export type { ElementOrder, FileGroup, FileMesh, NodeData, SurfaceRegions } from "./mesh/file-mesh.js";
export {
  fileMeshOf,
  patchNames,
  regionSummaries,
  type NameSource,
  type RegionSummary,
} from "./api/generated-mesh.js";
export {
  readMesh,
  readSurface,
  readVolume,
  writeMesh,
  type ReadFileOptions,
  type WriteFileOptions,
  type WriteProgress,
} from "./api/mesh-files.js";
export type { LengthOptions } from "./formats/units.js";
export type { SurfaceFile } from "./formats/surface-file.js";
export { unusedData, volumeBackground } from "./api/volume-background.js";
export type { VolumeFile } from "./formats/volume-file.js";
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
  type Refusal,
  REFUSALS,
  STATION_ENDS,
  SWEEP_KINDS,
  type SweepKind,
  type StationEnd,
  TRACE_STATUSES,
  type TraceStatus,
} from "./trace/layout.js";
export { backgroundArrays, projectBackground } from "./project/grid-arrays.js";
export {
  type EdgeLengths,
  type MeshInspection,
  type Position,
  type RepairChange,
  type SharedVolume,
  type ShellInfo,
  type SurfaceInspection,
  type SurfaceRefinement,
  type MergedDetail,
  type SurfaceRemesh,
  type SurfaceRepair,
  type TriangleQuality,
} from "./mesh/inspection.js";
export { type RepairOptions } from "./api/option-types.js";
export {
  type BestRepair,
  type BestRepairOptions,
  hasWelded,
  remeshedBest,
  type RemeshShapes,
} from "./api/best-repair.js";
export { createMesher } from "./api/mesher.js";
export {
  meshFile,
  type MeshedFile,
  type MeshFileOutcome,
  type MeshFileOptions,
  type MeshFileReport,
} from "./api/mesh-file.js";
export type { ChangedSurface, MeshedSurface, RefinementCounts, RemeshReport } from "./api/meshed-surface.js";
export type { ReadySurface } from "./api/surface-meshing.js";
export type { Treatment } from "./api/surface-treatment.js";
export { SURFACE_TREATMENTS, type SurfaceMeshOptions, type SurfaceTreatment } from "./api/option-types.js";
export { measureTriangles } from "./api/triangle-shapes.js";
export type { TriangleShapes } from "./mesh/triangle-shapes.js";
export { recordTrace } from "./api/trace-recording.js";
export type { RecordedMesh, RecordingOptions } from "./api/trace-recording.js";
export {
  MesherError,
  type MesherErrorCode,
  type MesherErrorData,
  type MesherErrorOf,
  type OutOfMemory,
} from "./diagnostics/mesher-error.js";
export { parseProject, readProject, writeProject } from "./project/project.js";
export { LIMITS, STEP_HEIGHT } from "./base/limits.js";
export { bodyPatchGroups, bodyWithPatches, mergePatches } from "./api/body-patches.js";
export { bodySurface, createBody, type NewBody, type PlacedSurface } from "./project/bodies.js";
export { createBodies, type SolidSurface } from "./project/solid-bodies.js";
export { BODY_SURFACES, PROJECT_FORMAT, projectSchema } from "./project/schema.js";
export { liveNotes } from "./project/live-notes.js";
export { EXPRESSION_KINDS, GROUP_KINDS } from "./project/notes.js";
export { PROJECT_VERSION } from "./project/versions.js";
export type {
  BodyId,
  BodyPlacement,
  BodyRemeshing,
  BodyRepair,
  BodySurface,
  LineId,
  PatchId,
  PointId,
  Project,
  ProjectBackground,
  ProjectBackgroundNode,
  ProjectBody,
  ProjectBodyPatch,
  ProjectExpression,
  ProjectGroup,
  ProjectLine,
  ProjectMeshing,
  ProjectParameter,
  ProjectPatch,
  ProjectPoint,
  ProjectSource,
  SourceId,
} from "./project/schema.js";
export type { ReadCode, ReadError, ReadResult } from "./diagnostics/read-error.js";
export { improvedMesh } from "./api/improvement.js";
export {
  improvedResult,
  inspectedResult,
  meshWithBoundary,
  type MeshWithBoundary,
} from "./api/given-mesh.js";
export type { ImproveInput, MeshImprovement, MeshShapes } from "./mesh/improvement.js";
export { repairedSurface } from "./api/repaired-surface.js";
export type { AbortControl, PartialControl, RunControl, UnoptimizedMesh } from "./engine/control.js";
export type { BackgroundArrays } from "./project/background-arrays.js";
export type {
  CoverOptions,
  ImproveOptions,
  InspectionOptions,
  MeshOptions,
  PreviewOptions,
  ProjectMeshOptions,
  ProposalOptions,
  RefineOptions,
  RemeshOptions,
  SplitOptions,
  SurfaceProposalOptions,
} from "./api/option-types.js";
export type { Diagnostic, DiagnosticOf, EntityRef } from "./diagnostics/diagnostic.js";
export type {
  EdgeStatistics,
  ElementQuality,
  LimitedByBoundary,
  MetricShapes,
  PatchQuality,
  PoorElements,
  QualityReport,
  RegionQuality,
  ShapeStatistics,
} from "./mesh/quality.js";
export type {
  Mesher,
  SizeProposal,
  SizeSamples,
  SplitInput,
  SplitSurface,
  SurfaceSizeProposal,
} from "./api/mesher-interface.js";
export type { LocatedSurface } from "./api/region-location.js";
export type {
  GivenRegions,
  MeshInput,
  PatchedSurface,
  RegionPoint,
  RegionPoints,
  SurfaceInput,
  SurfaceMesh,
  VolumeMesh,
} from "./mesh/mesh.js";
export type {
  ElementCount,
  FrontRecording,
  MeshReport,
  MeshResult,
  MeshStatus,
  Seconds,
} from "./mesh/report.js";
export type { PreparedBody } from "./mesh/prepared-body.js";
export type { Progress, ProgressPhase } from "./base/progress.js";
export type { ProjectPreview } from "./project/preview.js";
export { type Unit, UNITS } from "./mesh/units.js";
export { isInterface } from "./mesh/interfaces.js";

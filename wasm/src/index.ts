/**
 * Tetrafront: tetrahedral meshes by the advancing-front method (Löhner & Parikh 1988). Recorded runs are in `tetrafront/trace`,
 * projects of the editor in `tetrafront/project`.
 *
 *     import { createMesher, readSurface, writeMesh } from "tetrafront";
 */
export {
  type CheckedOption,
  type CoverShape,
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
  REMESH_DEFAULTS,
  type Severity,
  type SourceType,
  type EngineCode,
  type EngineStatus,
} from "./generated/constants.js";
export type { Counted, DiagnosticData, DiagnosticNumbers, NoData, ReadLocation } from "./diagnostics/data.js";
export type { DiagnosticCode, PackageCode } from "./diagnostics/codes.js";
export {
  type ErrorCode,
  MesherError,
  type MesherErrorCode,
  type MesherErrorData,
  type MesherErrorOf,
  type OutOfMemory,
} from "./diagnostics/mesher-error.js";
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
export { regionSummaries, type RegionSummary } from "./api/generated-mesh.js";
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
export type {
  EdgeLengths,
  MeshInspection,
  Position,
  RepairChange,
  SharedVolume,
  ShellInfo,
  SurfaceInspection,
  SurfaceRefinement,
  MergedDetail,
  SurfaceRemesh,
  SurfaceRepair,
  TriangleQuality,
} from "./mesh/inspection.js";
export {
  type RepairOptions,
  SURFACE_TREATMENTS,
  type SurfaceMeshOptions,
  type SurfaceTreatment,
  type CoverOptions,
  type ImproveOptions,
  type InspectionOptions,
  type MeshOptions,
  type PreviewOptions,
  type ProjectMeshOptions,
  type ProposalOptions,
  type RefineOptions,
  type RemeshOptions,
  type SplitOptions,
  type SurfaceProposalOptions,
} from "./api/option-types.js";
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
export { measureTriangles } from "./api/triangle-shapes.js";
export type { TriangleShapes } from "./mesh/triangle-shapes.js";
export { LIMITS } from "./base/limits.js";
export type { ReadCode, ReadError, ReadResult } from "./diagnostics/read-error.js";
export type { MeshImprovement, MeshShapes } from "./mesh/improvement.js";
export type { AbortControl, PartialControl, RunControl } from "./engine/control.js";
export type { BackgroundArrays } from "./project/background-arrays.js";
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
  PatchSplit,
  SurfaceSizeProposal,
} from "./api/mesher-interface.js";
export type { RegionLocation } from "./api/region-location.js";
export type {
  ElementOrder,
  FileGroup,
  GivenRegions,
  Mesh,
  NodeData,
  PartialMesh,
  RegionPoint,
  RegionPoints,
  SurfaceInput,
  SurfaceRegions,
  VolumeInput,
} from "./mesh/mesh.js";
export type { ElementCount, MeshReport, MeshResult, MeshStatus, Seconds } from "./mesh/report.js";
export type { PreparedBody } from "./mesh/prepared-body.js";
export type { Progress, ProgressPhase } from "./base/progress.js";
export { type Unit, UNITS } from "./mesh/units.js";

/**
 * Tetrafront: tetrahedral meshes by the advancing-front method (Löhner & Parikh 1988). Recorded runs are in `tetrafront/trace`,
 * projects of the editor in `tetrafront/project`.
 *
 *     import { createMesher, readSurface, writeMesh } from "tetrafront";
 */

// The mesher: its calls, their options and results.
export { createMesher } from "./api/mesher.js";
export type {
  Mesher,
  PatchSplit,
  ProjectCheck,
  SizeProposal,
  CurvatureSamples,
  SizeSamples,
  SurfaceSizeProposal,
} from "./api/mesher-interface.js";
export {
  type CoverOptions,
  type CurvatureOptions,
  type CycleOptions,
  type AdaptOptions,
  type LayerOptions,
  type ImproveOptions,
  type InspectionOptions,
  type MeshOptions,
  type PreviewOptions,
  type ProjectMeshOptions,
  type ProposalOptions,
  type RefineOptions,
  type RemeshOptions,
  type RepairOptions,
  type SolutionSizeOptions,
  type SplitOptions,
  SURFACE_TREATMENTS,
  type SurfaceMeshOptions,
  type SurfaceProposalOptions,
  type SurfaceTreatment,
  type TransferOptions,
} from "./api/option-types.js";
export {
  ERROR_NORMS,
  type ErrorNorm,
  FRONT_ORDERS,
  type FrontOrder,
  INNER_SHELLS,
  type InnerShells,
  MESH_DEFAULTS,
  NO_ORIGIN,
  NO_REGION,
  type Interior,
  INTERIORS,
  type Optimization,
  OPTIMIZATIONS,
  REMESH_DEFAULTS,
} from "./generated/constants.js";
export { LIMITS } from "./base/limits.js";
export type { CallProgress, ProgressPhase } from "./base/progress.js";
export type { PartialControl, RunControl } from "./engine/control.js";
export type { BackgroundArrays } from "./project/background-arrays.js";

// Meshes, and what is known of them.
export type {
  ElementOrder,
  Mesh,
  MeshGroup,
  NodeData,
  RegionPoint,
  RegionPoints,
  SurfaceInput,
  SurfaceRegions,
  VolumeInput,
  CurvedEdges,
} from "./mesh/mesh.js";
export type { ElementBlocks, RegionRun } from "./mesh/element-blocks.js";
export type { MeshReport, MeshResult, MeshStatus, RegionSummary } from "./mesh/report.js";
export type { MeshedSurface } from "./api/meshed-surface.js";
export type { RegionLocation } from "./api/region-location.js";
export type {
  MeshInspection,
  RepairChange,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRemesh,
  SurfaceRepair,
} from "./mesh/inspection.js";
export type { MeshAdaptation, MetricStatistics } from "./mesh/adaptation.js";
export type { LayeredMesh, LayersMade, PatchLayers } from "./mesh/layered-mesh.js";
export type {
  AdaptationCycle,
  Solution,
  Solve,
  SolveContext,
  SolvedFields,
} from "./mesh/adaptation-cycle.js";
export type { MeshImprovement } from "./mesh/improvement.js";
export type { PreparedBody } from "./mesh/prepared-body.js";
export type { QualityReport } from "./mesh/quality.js";
export type { CurvedMesh, SecondOrderQuality } from "./mesh/second-order.js";
export type { FieldIntegral, FieldValues, SolutionSizes, TransferredFields } from "./mesh/solution.js";
export { measureTriangles } from "./api/triangle-shapes.js";
export type { TriangleShapes } from "./mesh/triangle-shapes.js";

// Files.
export { meshFile, type MeshedFile, type MeshFileOptions, type MeshFileReport } from "./api/mesh-file.js";
export {
  type ReadFileOptions,
  readMesh,
  readSurface,
  readVolume,
  streamMesh,
  type WriteFileOptions,
  writeMesh,
} from "./api/mesh-files.js";
export type { ByteSource } from "./formats/byte-source.js";
export type {
  FileFormat,
  OpenOther,
  StreamedFile,
  StreamedMesh,
  WrittenFile,
} from "./formats/file-format.js";
export { extensionsFor, FILE_FORMATS, formatOf } from "./formats/file-formats.js";
export type { LengthOptions } from "./formats/units.js";
export { LENGTH_UNITS, type LengthUnit } from "./mesh/units.js";
export { setCadLibrary } from "./cad/cad-library.js";
export type { CadLibrary } from "./cad/protocol.js";

// Problems.
export type { DiagnosticCode } from "./diagnostics/codes.js";
export type { Diagnostic, EntityRef } from "./diagnostics/diagnostic.js";
export { type ErrorCode, MesherError, type MesherErrorCode } from "./diagnostics/mesher-error.js";
export type { ReadError, ReadResult } from "./diagnostics/read-error.js";

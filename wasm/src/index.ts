/**
 * Tetrafront: tetrahedral meshes by the advancing-front method (Löhner & Parikh 1988).
 *
 *     import { createMesher, readProject, writeVtu } from "tetrafront";
 */
export { ENGINE_CODES } from "./diagnostic-codes.js";
export type { DiagnosticCode, EngineCode, PackageCode } from "./diagnostic-codes.js";
export { describeDiagnostic, ENTITY_KINDS, type EngineDiagnostic } from "./diagnostics.js";
export { MESH_WRITERS, patchNames, SURFACE_READERS, VOLUME_READERS } from "./formats/file-formats.js";
export { writeMedit } from "./formats/medit.js";
export { readMsh } from "./formats/msh-reader.js";
export type { GroupNames } from "./formats/groups.js";
export { writeMsh } from "./formats/msh.js";
export { readObj } from "./formats/obj.js";
export { readOff } from "./formats/off.js";
export { readPly } from "./formats/ply.js";
export { readStl } from "./formats/stl.js";
export { writeSu2 } from "./formats/su2.js";
export { volumeBackground } from "./formats/volume-background.js";
export type { NodeData, VolumeFile } from "./formats/volume-file.js";
export { writeVtk } from "./formats/vtk.js";
export { readVtu } from "./formats/vtu-reader.js";
export { writeVtu } from "./formats/vtu.js";
export { backgroundArrays, projectBackground } from "./grid-arrays.js";
export { createMesher, MesherError } from "./mesher.js";
export type { MesherErrorCode } from "./mesher.js";
export { parseProject, readProject, writeProject } from "./project.js";
export { nameByPosition, projectNamer, type EntityNamer } from "./project-arrays.js";
export { PROJECT_FORMAT, PROJECT_VERSION, projectJsonSchema, projectSchema } from "./project-schema.js";
export type {
  LineId,
  LineType,
  PatchId,
  PatchType,
  PointId,
  Project,
  ProjectBackground,
  ProjectBackgroundNode,
  ProjectLine,
  ProjectPatch,
  ProjectPoint,
  ProjectSource,
  SourceId,
  SourceType,
} from "./project-schema.js";
export type { ReadProblem, ReadResult } from "./read-result.js";
export type {
  BackgroundArrays,
  CoverOptions,
  Diagnostic,
  ElementFigures,
  EntityKind,
  EntityRef,
  FrontOrder,
  Mesher,
  MeshOptions,
  MeshReport,
  MeshResult,
  MeshStatus,
  Optimization,
  PatchFigures,
  Phase,
  PreviewOptions,
  Progress,
  ProjectPreview,
  ProposalOptions,
  QualityReport,
  RegionQuality,
  RunControl,
  Seconds,
  Severity,
  SizeProposal,
  SurfaceInput,
  SurfaceMesh,
  VolumeMesh,
} from "./types.js";

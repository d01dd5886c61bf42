/**
 * Projects of the editor: models of points, lines, patches and bodies, with their background grid (docs/FORMAT.md).
 *
 *     import { readProject, writeProject, type Project } from "tetrafront/project";
 */
export { backgroundArrays, projectBackground } from "./project/grid-arrays.js";
export { parseProject, readProject, writeProject } from "./project/project.js";
export { bodyPatchGroups, bodyWithPatches, mergePatches } from "./api/body-patches.js";
export { bodySurface, createBody, type NewBody, type PlacedSurface } from "./project/bodies.js";
export { createBodies, type SolidSurface } from "./project/solid-bodies.js";
export {
  BODY_SURFACES,
  PROJECT_FORMAT,
  type BodyId,
  type BodyPlacement,
  type BodyRemeshing,
  type BodyRepair,
  type BodySurface,
  type LineId,
  type PatchId,
  type PointId,
  type Project,
  type ProjectBackground,
  type ProjectBackgroundNode,
  type ProjectBody,
  type ProjectBodyPatch,
  type ProjectCondition,
  type ProjectExpression,
  type ProjectGroup,
  type ProjectLine,
  type ProjectMeshing,
  type ProjectParameter,
  type ProjectPatch,
  type ProjectPoint,
  type ProjectProblem,
  type ProjectSource,
  type SourceId,
} from "./project/project-types.js";
export type { LineType, PatchType, SourceType } from "./generated/constants.js";
export type { SolidFeature } from "./project/feature-schema.js";
export { liveNotes } from "./project/live-notes.js";
export { EXPRESSION_KINDS, GROUP_KINDS } from "./project/project-types.js";
export { PROJECT_VERSION } from "./project/versions.js";
export type { ProjectPreview } from "./project/preview.js";

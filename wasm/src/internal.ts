/**
 * What the application shares with the package. No part of the package's promise: it may change in any version.
 */
export { ENGINE_CODES, type EngineNumbers, PROPOSAL_DEFAULTS, SOURCE_GROWTH } from "./generated/constants.js";
export { unusedData } from "./api/node-sizes.js";
export {
  type BestRepair,
  type BestRepairOptions,
  hasWelded,
  remeshedBest,
  type RemeshShapes,
} from "./api/best-repair.js";
export { withSolidsOfPatches } from "./api/touching-solids.js";
export { base64Of } from "./base/base64.js";
export { nearPairs } from "./base/boxes.js";
export { dataOf, fieldsOf } from "./mesh/mesh-fields.js";
export { isWithin, sharedPairs, solidUnits, type SolidsSurface } from "./formats/solid-units.js";
export { differentNames } from "./formats/groups.js";
export { featureSolid, type FeatureSolid } from "./formats/feature-solid.js";
export type {
  FaceLook,
  FeatureFailure,
  GridFace,
  Loop,
  LoopCurve,
  Profile,
  SewnFace,
} from "./cad/features/feature.js";
export { deviationOf, rowsOf } from "./cad/features/grid-surface.js";
export { type ImportedPart, partOfFile, type PartFile } from "./cad/features/import.js";
export type { EdgeLine } from "./cad/features/evaluate.js";
export { type DrawnSolid, drawnSolid, type SolidDrawing } from "./cad/features/drawing.js";
export { importKernel } from "./cad/kernel-browser.js";
export type { FeatureKernel } from "./cad/features/session.js";
export { createUnitBodies } from "./project/solid-bodies.js";
export { bodyBox } from "./project/bodies.js";
export { connectedGroups } from "./base/connected-groups.js";
export { roundTime, TimeLeft } from "./base/time-left.js";
export { STEP_HEIGHT } from "./base/limits.js";
export { projectSchema } from "./project/schema.js";
export { sharedSchemas } from "./project/feature-schema.js";
export {
  improvedResult,
  inspectedResult,
  meshWithBoundary,
  type MeshWithBoundary,
} from "./api/given-mesh.js";
export { patchNames } from "./api/generated-mesh.js";
export { correctedNumber } from "./api/corrected-number.js";
export { estimatedErrors } from "./api/solution-error.js";
export { inOrder } from "./api/second-order-mesh.js";
export type { MeshShapes } from "./mesh/improvement.js";
export type {
  ElementQuality,
  MetricShapes,
  PatchQuality,
  RegionQuality,
  ShapeStatistics,
} from "./mesh/quality.js";
export { isInterface } from "./mesh/interfaces.js";
export {
  receiveWatched,
  type LifeReply,
  type LifeRequest,
  type LifeWatch,
  watchLife,
} from "./calls/worker-life.js";

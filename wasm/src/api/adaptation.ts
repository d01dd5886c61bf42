/** Adapts a mesh to the metric of a background mesh. */
import { placedPoints, unplacedPoints } from "../base/placement.js";
import { describeAll } from "../diagnostics/describe.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { PartialControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import type { AnswerOf } from "../engine/calls.js";
import { countOf, numbered } from "../formats/groups.js";
import { ADAPT_DEFAULTS } from "../generated/constants.js";
import type { MeshAdaptation, MetricStatistics } from "../mesh/adaptation.js";
import type { Mesh, VolumeInput } from "../mesh/mesh.js";
import { beginCall } from "./call-checks.js";
import { patchesIn } from "./carried-mesh.js";
import { checkImproveInput, checkMesh, unreadableMesh } from "./input-checks.js";
import { checkAdaptOptions } from "./mesh-options.js";
import { backgroundMetrics, wrongMetrics } from "./node-sizes.js";
import type { AdaptOptions } from "./option-types.js";
import { modelOf, scaleOfFaces } from "./true-faces.js";

type EngineAdaptation = AnswerOf<"adaptMesh">;

export async function adaptMesh(
  client: EngineClient,
  { mesh, background }: { readonly mesh: VolumeInput; readonly background: VolumeInput },
  options: AdaptOptions,
  control: PartialControl,
): Promise<MeshAdaptation> {
  beginCall(client, control);
  refuse([...checkImproveInput(mesh), ...checkMesh(background, "background"), ...checkAdaptOptions(options)]);
  const { leastQuality = ADAPT_DEFAULTS.leastQuality, sweeps = ADAPT_DEFAULTS.sweeps } = options;
  const given = [adaptInputOf(mesh), adaptBackgroundOf(background, mesh), { leastQuality, sweeps }] as const;
  const found = await client.ask("adaptMesh", given, control);
  if (!found.isReadable) refuse([unreadableMesh()]);
  refuse(describeAll(found.diagnostics, nameByIndex));
  return describedAdaptation(found, mesh);
}

/** Returns the factor of lengths from the true faces of a mesh to it; the engine adapts meshes with the lengths of their faces. */
export const adaptScaleOf = (mesh: VolumeInput): number => scaleOfFaces(mesh) ?? 1;

/** Returns a copy of the background of an adaptation as the engine reads it. Throws a `MesherError` if its metrics are wrong. */
export function adaptBackgroundOf(background: VolumeInput | undefined, mesh: VolumeInput) {
  const { points = new Float64Array(), tetrahedra = new Uint32Array() } = background ?? {};
  const metrics = background === undefined ? new Float64Array() : backgroundMetrics(background);
  refuse(wrongMetrics(metrics));
  const scale = adaptScaleOf(mesh);
  return {
    points: unplacedPoints(points, { scale }),
    tetrahedra: tetrahedra.slice(),
    metrics: metrics.map((value) => value * scale * scale),
  };
}

/** Returns a copy of a mesh as the engine adapts it. */
export function adaptInputOf(mesh: VolumeInput) {
  const { points, tetrahedra, tetrahedronRegion, triangles, trianglePatch } = mesh;
  const { numbers: model, ...modelTriangles } = modelOf(mesh);
  return {
    points: unplacedPoints(points, { scale: adaptScaleOf(mesh) }),
    tetrahedra: tetrahedra.slice(),
    regions: tetrahedronRegion?.slice() ?? new Uint32Array(),
    triangles: triangles?.slice() ?? new Uint32Array(),
    trianglePatch: trianglePatch?.slice() ?? new Uint32Array(),
    model,
    modelTriangles,
  };
}

/** Returns what the engine made of a mesh, with the names of its patches and regions. */
export function describedAdaptation(found: EngineAdaptation, given: VolumeInput): MeshAdaptation {
  const { isPartial, before, after } = found;
  return {
    mesh: adaptedMesh(found, given),
    isPartial,
    before: plain(before),
    after: plain(after),
    diagnostics: [],
  };
}

function plain({ lengths, ...rest }: EngineAdaptation["after"]): MetricStatistics {
  return { ...rest, lengths: [...lengths] };
}

function adaptedMesh(found: EngineAdaptation, given: VolumeInput): Mesh {
  const { tetrahedra, triangles, trianglePatch, regions: tetrahedronRegion } = found;
  const { regions = [], patches = [], trueFaces, unit } = given;
  const scale = adaptScaleOf(given);
  const metrics = found.metrics.map((value) => value / (scale * scale));
  return {
    points: placedPoints(found.points, { scale }),
    triangles,
    ...patchesIn({ triangles, trianglePatch, patches }),
    tetrahedra,
    tetrahedronRegion,
    regions: regions.length > 0 ? regions : numbered("region", countOf(tetrahedronRegion)),
    nodeData: new Map([["metric", { components: 6, values: metrics }]]),
    ...(trueFaces && { trueFaces }),
    ...(unit && { unit }),
  };
}

/** Calls of a mesher about tetrahedra. */
import type { PartialControl, RunControl } from "../engine/control.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { EngineClient } from "../engine/engine-client.js";
import type { MeshInspection } from "../mesh/inspection.js";
import type { MeshImprovement } from "../mesh/improvement.js";
import type { VolumeInput } from "../mesh/mesh.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import { backgroundFrom } from "../project/grid-arrays.js";
import { beginCall } from "./call-checks.js";
import { checkImproveInput, checkMesh, checkVolume, unreadableMesh } from "./input-checks.js";
import { describedMesh } from "./inspection.js";
import { describedImprovement, improvementErrors } from "./improvement.js";
import { frontSizeData, metricsAtNodes, type NodeSizes, notPositive, sizesAtNodes } from "./node-sizes.js";
import type { ImproveOptions } from "./option-types.js";
import { checkGridOptions } from "./grid-options.js";
import { checkImproveOptions, engineImproveOptions } from "./mesh-options.js";

export class VolumeTools {
  readonly #client: EngineClient;

  constructor(client: EngineClient) {
    this.#client = client;
  }

  async inspect(mesh: VolumeInput, control: RunControl): Promise<MeshInspection> {
    beginCall(this.#client, control);
    refuse(checkMesh(mesh));
    const { points, tetrahedra, tetrahedronRegion: regions = new Uint32Array() } = mesh;
    const given = [points.slice(), tetrahedra.slice(), regions.slice()] as const;
    const found = await this.#client.ask("inspectMesh", given, control);
    if (!found.isReadable) refuse([unreadableMesh()]);
    return describedMesh(found, mesh.invertedTetrahedra?.length);
  }

  async improve(
    mesh: VolumeInput,
    options: ImproveOptions,
    control: PartialControl,
  ): Promise<MeshImprovement> {
    beginCall(this.#client, control);
    refuse([...checkImproveInput(mesh), ...checkImproveOptions(options)]);
    const { points, tetrahedra, triangles = new Uint32Array() } = mesh;
    const { tetrahedronRegion: regions = new Uint32Array() } = mesh;
    const given = [
      points.slice(),
      tetrahedra.slice(),
      regions.slice(),
      triangles.slice(),
      engineImproveOptions(options),
    ] as const;
    const found = await this.#client.ask("improveMesh", given, control);
    if (!found.isReadable) refuse([unreadableMesh()]);
    refuse(improvementErrors(found));
    return describedImprovement(found, mesh);
  }

  async background(
    mesh: VolumeInput,
    options: { readonly sizes?: Float64Array | undefined },
    control: RunControl,
  ): Promise<BackgroundArrays> {
    beginCall(this.#client, control);
    refuse(checkGridOptions(options));
    refuse(checkVolume(mesh, options.sizes));
    const { sizes, ...stretched } =
      options.sizes === undefined ? await this.#sizesAtNodes(mesh, control) : options;
    refuse(checkVolume(mesh, sizes));
    const { points, tetrahedra } = mesh;
    const none = new Uint32Array();
    const volume = { points: points.slice(), tetrahedra: tetrahedra.slice(), regions: none, front: none };
    const given = [volume, sizes?.slice() ?? new Float64Array()] as const;
    return { ...backgroundFrom(await this.#client.ask("backgroundFromMesh", given, control)), ...stretched };
  }

  /** Returns the sizes at the nodes of a mesh; those of its metric if it has no others. */
  async #sizesAtNodes(mesh: VolumeInput, control: RunControl): Promise<NodeSizes> {
    const metrics = metricsAtNodes(mesh);
    if (metrics === undefined) return sizesAtNodes(mesh);
    const front = await this.#client.ask("frontSizesOf", [metrics.slice()], control);
    if (front.invalidNode < metrics.length / 6) refuse([notPositive(front.invalidNode)]);
    return sizesAtNodes({ ...mesh, nodeData: frontSizeData(front) });
  }
}

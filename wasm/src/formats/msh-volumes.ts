/** Volumes of Gmsh's model in files that hold its surfaces alone: by the surfaces that bound them, or by their name. */
import { NO_REGION } from "../base/interfaces.js";
import type { FileMesh } from "./file-mesh.js";
import { GroupList } from "./mesh-builder.js";
import type { SurfaceRegions } from "./region-names.js";

export class MshVolumes {
  /** Physical groups of volumes, by the surface that bounds them. */
  readonly #groups = new Map<number, number[]>();
  /** Where the triangles of each surface begin, as they come. */
  readonly #runs: { readonly begin: number; readonly surface: number }[] = [];

  /** A volume of this physical group is on one side of this surface; its sign says on which. */
  bound(surface: number, group: number): void {
    const tag = Math.abs(surface);
    const known = this.#groups.get(tag);
    if (known === undefined) this.#groups.set(tag, [group]);
    else if (known.length < 2) known.push(group);
  }

  /** The triangles from the one of this number on are of this surface. */
  trianglesFollow(begin: number, surface: number): void {
    this.#runs.push({ begin, surface });
  }

  /** Undefined where the file tells nothing. Without volumes a single name is that of all. */
  regions(
    { triangles }: Pick<FileMesh, "triangles">,
    names: ReadonlyMap<number, string>,
  ): SurfaceRegions | undefined {
    const regions = new GroupList("region");
    const triangleRegions = new Uint32Array((2 * triangles.length) / 3).fill(NO_REGION);
    this.#runs.forEach(({ begin, surface }, r) => {
      const end = this.#runs[r + 1]?.begin ?? triangles.length / 3;
      const [first, second] = this.#groups.get(surface) ?? [];
      for (let t = begin; t < end; t++) {
        if (first !== undefined) triangleRegions[2 * t] = regions.tagged(first);
        if (second !== undefined) triangleRegions[2 * t + 1] = regions.tagged(second);
      }
    });
    if (this.#groups.size === 0 && names.size === 1) {
      for (const tag of names.keys()) regions.tagged(tag);
      for (let side = 0; side < triangleRegions.length; side += 2) triangleRegions[side] = 0;
    }
    return regions.length === 0 ? undefined : { regions: regions.groups(names), triangleRegions };
  }
}

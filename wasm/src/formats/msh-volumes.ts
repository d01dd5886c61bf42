/** Volumes of a Gmsh model in a file that holds its surfaces only, found by the surfaces that bound them or by name. */
import type { Mesh, SurfaceRegions } from "../mesh/mesh.js";
import { NO_REGION } from "../generated/constants.js";
import { GroupList } from "./mesh-builder.js";

export class MshVolumes {
  /** Physical groups of volumes, by the tag of the bounding surface. */
  readonly #groups = new Map<number, number[]>();
  /** First triangle of each surface, in file order. */
  readonly #runs: { readonly begin: number; readonly surface: number }[] = [];

  /** Records that a volume of this physical group is on one side of this surface. The sign states the side. */
  bound(surface: number, group: number): void {
    const tag = Math.abs(surface);
    const known = this.#groups.get(tag);
    if (known === undefined) this.#groups.set(tag, [group]);
    else if (known.length < 2) known.push(group);
  }

  /** Records that the triangles from index `begin` on belong to this surface. */
  trianglesFollow(begin: number, surface: number): void {
    this.#runs.push({ begin, surface });
  }

  /**
   * Returns the regions on the sides of the triangles; undefined if the file defines none. If it defines no
   * volumes, a single name applies to all.
   */
  regions(
    { triangles }: Pick<Mesh, "triangles">,
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

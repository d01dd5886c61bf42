import { placedSurfaceKey } from "../document/content-keys";
import { bodiesOf } from "../document/entities";
import type { ShownState } from "./scene-state";

/** Remembers which bodies the mesh that is shown was made of, and where they were. */
export class MeshedBodies {
  #mesh: ShownState["mesh"] = null;
  /** A key per body; null for a mesh that has not been up to date since it is shown. */
  #keys: ReadonlySet<string> | null = null;

  /** Returns whether the mesh of a state is out of date because the bodies of the project are others, or elsewhere. */
  areOthers({ mesh, isMeshStale, project }: Pick<ShownState, "mesh" | "isMeshStale" | "project">): boolean {
    const keys = bodiesOf(project).map(placedSurfaceKey);
    if (mesh !== this.#mesh || !isMeshStale) this.#keys = isMeshStale ? null : new Set(keys);
    this.#mesh = mesh;
    const meshed = this.#keys;
    return meshed !== null && (meshed.size !== new Set(keys).size || keys.some((key) => !meshed.has(key)));
  }
}

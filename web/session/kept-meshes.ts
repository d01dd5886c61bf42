/** Meshes that were shown, so that undo restores them at once. */
import type { RunNote } from "./run-log";
import type { ShownMesh } from "./shown-mesh";

/** A mesh, and the warnings of the preparation of its run. */
interface KeptMesh {
  readonly shown: ShownMesh;
  readonly warnings: readonly RunNote[];
}

const maxMeshes = 6;

export class KeptMeshes {
  readonly #kept = new Map<string, KeptMesh>();

  get(key: string): KeptMesh | undefined {
    return this.#kept.get(key);
  }

  /** Keeps a mesh. The oldest one that a run can make again is dropped first, then the oldest one. */
  add(key: string, shown: ShownMesh, warnings: KeptMesh["warnings"] = []): void {
    this.#kept.delete(key);
    this.#kept.set(key, { shown, warnings });
    if (this.#kept.size <= maxMeshes) return;
    const all = [...this.#kept];
    const [dropped] = all.find(([, { shown: other }]) => other.isValid === null) ?? all[0] ?? [];
    if (dropped !== undefined) this.#kept.delete(dropped);
  }
}

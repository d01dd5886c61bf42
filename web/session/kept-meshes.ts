/** Meshes that were shown, so that undo restores them at once. */
import type { RunNote } from "./run-log";
import type { ShownMesh } from "./shown-mesh";

/** A mesh, and the warnings of the preparation of its run. */
interface KeptMesh {
  readonly shown: ShownMesh;
  readonly warnings: readonly RunNote[];
  /** The document that has shown it last. */
  readonly documentId: string;
}

const maxMeshes = 6;

export class KeptMeshes {
  readonly #kept = new Map<string, KeptMesh>();
  /** The documents whose steps of undo can be shown: the present one, and the one before it, which can be opened again. */
  #documents: readonly [present: string, before?: string];

  constructor(documentId: string) {
    this.#documents = [documentId];
  }

  /** Notes that a document takes the place of another one. */
  open(documentId: string, before: string): void {
    this.#documents = [documentId, before];
  }

  /** Returns the mesh with this key, which the present document then shows; undefined if it is not kept. */
  show(key: string): KeptMesh | undefined {
    const kept = this.#kept.get(key);
    if (kept) this.#kept.set(key, { ...kept, documentId: this.#presentId });
    return kept;
  }

  /**
   * Keeps a mesh of the present document. Of the others, the oldest one of a document that was left earlier is dropped first, then the
   * oldest one that a run can make again, then the oldest one.
   */
  add(key: string, shown: ShownMesh, warnings: KeptMesh["warnings"] = []): void {
    this.#kept.delete(key);
    const others = [...this.#kept];
    this.#kept.set(key, { shown, warnings, documentId: this.#presentId });
    if (this.#kept.size <= maxMeshes) return;
    const isLeft = ([, { documentId }]: (typeof others)[number]): boolean =>
      !this.#documents.includes(documentId);
    const isMadeByRun = ([, { shown: other }]: (typeof others)[number]): boolean => other.isValid === null;
    const [dropped] = others.find(isLeft) ?? others.find(isMadeByRun) ?? others[0] ?? [];
    if (dropped !== undefined) this.#kept.delete(dropped);
  }

  get #presentId(): string {
    return this.#documents[0];
  }
}

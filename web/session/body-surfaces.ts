import type { ProjectBody } from "tetrafront/project";
import type { LoadedSurface, NewBody, SurfaceClient } from "../workers/surface-files";

/** Number of surfaces kept beyond those of the open document, so that undo restores them at once. */
const maxKept = 6;

interface KeptSurface {
  readonly texts: Pick<ProjectBody, "points" | "triangles" | "trianglePatch">;
  readonly loaded: LoadedSurface;
}

/** The given triangles of bodies as arrays. A worker converts them, unless they are known. */
export class BodySurfaces {
  readonly #client: SurfaceClient;
  /** The surface used last is the last one. */
  #kept: readonly KeptSurface[] = [];

  constructor(client: SurfaceClient) {
    this.#client = client;
  }

  /** Returns the surface of a body, if it is known. Compares texts, which is fast if they are the same objects. */
  find(body: ProjectBody): LoadedSurface | null {
    return this.#kept.find(({ texts }) => hasTexts(body, texts))?.loaded ?? null;
  }

  async load(body: ProjectBody): Promise<LoadedSurface> {
    const known = this.find(body);
    if (known) return known;
    const loaded = await this.#client.load(body);
    this.keep({ body, loaded });
    return loaded;
  }

  /** Notes the surface of a body that a worker has made. */
  keep({ body: { points, triangles, trianglePatch }, loaded }: Pick<NewBody, "body" | "loaded">): void {
    const texts = { points, triangles, trianglePatch };
    const others = this.#kept.filter((kept) => !hasTexts(texts, kept.texts));
    this.#kept = [...others, { texts, loaded }].slice(-maxKept);
  }
}

function hasTexts(body: KeptSurface["texts"], texts: KeptSurface["texts"]): boolean {
  return (
    body.points.length === texts.points.length &&
    body.trianglePatch === texts.trianglePatch &&
    body.triangles === texts.triangles &&
    body.points === texts.points
  );
}

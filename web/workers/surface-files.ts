import type { Mesh, SurfaceInput } from "tetrafront";
import type { MeshWithBoundary } from "tetrafront/internal";
import type { ProjectBody } from "tetrafront/project";
import type { DrawnSurface } from "../document/drawn-surface";
import type { PatchArrays } from "../document/patch-arrays";
import { unpackedBody, type PackedBody } from "./packed-bodies";
import { copyForTransfer } from "./transfer";
import { WorkerClient } from "./worker-client";

/** The given triangles of a body, as arrays. */
export interface LoadedSurface {
  readonly surface: PatchArrays;
  readonly drawn: DrawnSurface;
}

/** The texts of a body that hold its arrays. */
export type BodyTexts = Pick<ProjectBody, "points" | "triangles" | "trianglePatch">;

/** A body and its arrays. */
export interface NewBody {
  readonly body: ProjectBody;
  readonly loaded: LoadedSurface;
}

/** A body made in the worker. */
export interface PackedNewBody {
  readonly packed: PackedBody;
  readonly loaded: LoadedSurface;
}

/** Ids and name of a new body. */
export interface BodyHead {
  readonly id: number;
  readonly firstPatchId: number;
  readonly name: string;
}

export interface ReadSurface {
  /** One body per solid that touches no other; at least one. */
  readonly bodies: readonly NewBody[];
  /** Unit of the coordinates, if the file defines one. */
  readonly unit: string | undefined;
  /** Whether a solid lies in another one, so that inner shells are regions. */
  readonly hasInnerSolid: boolean;
  /** Sentences about content of the file that was ignored. */
  readonly notes: readonly string[];
}

/** The tetrahedra of a file, with their boundary in the patches of the body. */
export type OpenedMesh = Pick<MeshWithBoundary, "mesh" | "patchShapes">;

/** Other patches for the triangles of a body. */
export type NewPatches = Pick<Mesh, "trianglePatch" | "patches">;

/** What a file contains: its surface, or its mesh with a body that is the boundary. */
export interface FileContent extends ReadSurface {
  /** Null if the file has no tetrahedra. */
  readonly mesh: OpenedMesh | null;
}

export type SurfaceReading<Read = FileContent> =
  | ({ readonly success: true } & Read)
  | { readonly success: false; readonly reasons: readonly string[] };

/** A surface and the patches of a body, which replace those of a given body. */
export interface ReplacedSurface {
  readonly body: ProjectBody;
  readonly surface: PatchArrays;
  readonly patches: ProjectBody["patches"];
}

export interface SurfaceProtocol {
  readonly read: {
    /** `others`: files that it may need, by their names. */
    readonly argument: { readonly file: File; readonly others: readonly File[]; readonly head: BodyHead };
    readonly answer: SurfaceReading<
      Pick<FileContent, "unit" | "hasInnerSolid" | "notes" | "mesh"> & {
        readonly made: readonly PackedNewBody[];
      }
    >;
  };
  /** Returns the arrays of a body. */
  readonly load: { readonly argument: ProjectBody; readonly answer: PackedNewBody };
  readonly replace: { readonly argument: ReplacedSurface; readonly answer: PackedNewBody };
  readonly split: {
    readonly argument: {
      readonly body: ProjectBody;
      readonly split: NewPatches;
      readonly nextPatchId: number;
      /** Whether the triangles are drawn by patch even if patches have colours. */
      readonly isPreview: boolean;
    };
    readonly answer: PackedNewBody;
  };
  readonly merge: {
    readonly argument: { readonly body: ProjectBody; readonly ids: readonly number[] };
    readonly answer: PackedNewBody;
  };
  readonly draw: {
    readonly argument: {
      readonly surface: SurfaceInput;
      readonly patchCount: number;
      readonly values: Float32Array | Float64Array | null;
    };
    readonly answer: DrawnSurface;
  };
}

const startWorker = (): Worker =>
  new Worker(new URL("./surface-worker.ts", import.meta.url), {
    type: "module",
    name: "tetrafront-surfaces",
  });

async function unpacked({ packed, loaded }: PackedNewBody): Promise<NewBody> {
  return { body: await unpackedBody(packed), loaded };
}

const withTrianglesOf = (
  { points, triangles, trueFaces }: ProjectBody,
  { body, loaded }: NewBody,
): NewBody => ({
  body: { ...body, points, triangles, ...(trueFaces !== undefined && { trueFaces }) },
  loaded,
});

/**
 * Reads a surface or the mesh of a file in a worker of its own. Rejects if `signal` aborts or the worker fails, for
 * example out of memory.
 */
export async function readSurfaceFile(
  file: File,
  others: readonly File[],
  head: BodyHead,
  signal: AbortSignal,
): Promise<SurfaceReading> {
  const client = new WorkerClient<SurfaceProtocol>(startWorker);
  signal.addEventListener("abort", () => client.dispose());
  try {
    const read = await client.call("read", { file, others, head });
    if (!read.success) return read;
    const { made, unit, hasInnerSolid, notes, mesh } = read;
    const bodies: NewBody[] = [];
    for (const one of made) bodies.push(await unpacked(one));
    return { success: true, bodies, unit, hasInnerSolid, notes, mesh };
  } finally {
    client.dispose();
  }
}

/** Converts the surfaces of bodies between texts, arrays and triangles to draw, in a worker. */
export class SurfaceClient {
  readonly #worker = new WorkerClient<SurfaceProtocol>(startWorker);

  /** Returns the arrays of a body. */
  async load(body: ProjectBody): Promise<LoadedSurface> {
    const { packed, loaded } = await this.#worker.call("load", body);
    await unpackedBody(packed);
    return loaded;
  }

  /** Returns a body with another surface and other patches. */
  async replace({ body, surface, patches }: ReplacedSurface): Promise<NewBody> {
    const { copy, buffers } = await copyForTransfer(surface);
    const { points: _points, triangles: _triangles, trianglePatch: _patch, ...rest } = body;
    const head: ProjectBody = { ...rest, points: "", triangles: "" };
    return unpacked(await this.#worker.call("replace", { body: head, surface: copy, patches }, buffers));
  }

  /** Returns a body with the patches of a split. New patches get ids from `nextPatchId` on. A preview is drawn by patch. */
  async split(
    body: ProjectBody,
    { trianglePatch, patches }: NewPatches,
    nextPatchId: number,
    isPreview: boolean,
  ): Promise<NewBody> {
    const argument = { body, split: { trianglePatch, patches }, nextPatchId, isPreview };
    const answer = await this.#worker.call("split", argument);
    return withTrianglesOf(body, await unpacked(answer));
  }

  /** Returns a body in which the patches with the given ids are merged into the first of them. */
  async merge(body: ProjectBody, ids: readonly number[]): Promise<NewBody> {
    return withTrianglesOf(body, await unpacked(await this.#worker.call("merge", { body, ids })));
  }

  /** Returns the triangles to draw of a surface. */
  async draw(
    surface: SurfaceInput,
    patchCount: number,
    values: Float32Array | Float64Array | null,
  ): Promise<DrawnSurface> {
    // Before the wait: the caller may change its values during it.
    const copied = values?.slice() ?? null;
    const { copy, buffers } = await copyForTransfer(surface);
    return this.#worker.call("draw", { surface: copy, patchCount, values: copied }, [
      ...buffers,
      ...(copied ? [copied.buffer] : []),
    ]);
  }
}

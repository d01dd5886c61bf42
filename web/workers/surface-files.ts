import type { PatchedSurface, ProjectBody } from "tetrafront";
import type { DrawnSurface } from "../document/drawn-surface";
import type { SplitOptions, SplitPatches } from "../document/patch-splitting";
import { unpackedBody, type PackedBody } from "./packed-bodies";
import { copyForTransfer } from "./transfer";
import { WorkerClient } from "./worker-client";

/** Triangles whose patches are known. */
export interface PatchArrays {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  readonly trianglePatch: Uint32Array;
}

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

export interface ReadSurface extends NewBody {
  /** Sentences about content of the file that was ignored. */
  readonly notes: readonly string[];
}

export type SurfaceReading<Read = ReadSurface> =
  ({ readonly success: true } & Read) | { readonly success: false; readonly reasons: readonly string[] };

/** Patches that a split makes, and the triangles to draw, coloured by patch. */
export interface DrawnSplit {
  readonly split: SplitPatches;
  readonly drawn: DrawnSurface;
}

/** A surface and the patches of a body, which replace those of a given body. */
export interface ReplacedSurface {
  readonly body: ProjectBody;
  readonly surface: PatchArrays;
  readonly patches: ProjectBody["patches"];
}

export interface SurfaceProtocol {
  readonly read: {
    readonly argument: { readonly file: Blob; readonly fileName: string; readonly head: BodyHead };
    readonly answer: SurfaceReading<PackedNewBody & Pick<ReadSurface, "notes">>;
  };
  /** Returns the arrays of a body. */
  readonly load: { readonly argument: ProjectBody; readonly answer: PackedNewBody };
  readonly replace: { readonly argument: ReplacedSurface; readonly answer: PackedNewBody };
  readonly split: {
    readonly argument: {
      readonly surface: PatchArrays;
      readonly patches: ProjectBody["patches"];
      readonly options: SplitOptions;
    };
    readonly answer: DrawnSplit;
  };
  readonly draw: {
    readonly argument: {
      readonly surface: PatchedSurface;
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

/**
 * Reads a surface file in a worker of its own. Rejects if `signal` aborts or the worker fails, for example out of memory.
 */
export async function readSurfaceFile(
  file: Blob,
  fileName: string,
  head: BodyHead,
  signal: AbortSignal,
): Promise<SurfaceReading> {
  const client = new WorkerClient<SurfaceProtocol>(startWorker);
  signal.addEventListener("abort", () => client.dispose());
  try {
    const read = await client.call("read", { file, fileName, head });
    return read.success ? { success: true, ...(await unpacked(read)), notes: read.notes } : read;
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
    const { copy, buffers } = copyForTransfer(surface);
    const { points: _points, triangles: _triangles, trianglePatch: _patch, ...rest } = body;
    const head: ProjectBody = { ...rest, points: "", triangles: "" };
    return unpacked(await this.#worker.call("replace", { body: head, surface: copy, patches }, buffers));
  }

  /** Returns the patches of a body after a split. */
  split(surface: PatchArrays, patches: ProjectBody["patches"], options: SplitOptions): Promise<DrawnSplit> {
    const { copy, buffers } = copyForTransfer(surface);
    return this.#worker.call("split", { surface: copy, patches, options }, buffers);
  }

  /** Returns the triangles to draw of a surface. */
  draw(
    surface: PatchedSurface,
    patchCount: number,
    values: Float32Array | Float64Array | null,
  ): Promise<DrawnSurface> {
    const { copy, buffers } = copyForTransfer(surface);
    const copied = values?.slice() ?? null;
    return this.#worker.call("draw", { surface: copy, patchCount, values: copied }, [
      ...buffers,
      ...(copied ? [copied.buffer] : []),
    ]);
  }
}

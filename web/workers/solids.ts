import type { DrawnSolid, EdgeLine, FeatureFailure, ImportedPart, PartFile } from "tetrafront/internal";
import type { ProjectBody, SolidFeature } from "tetrafront/project";
import { unpackedBody } from "./packed-bodies";
import type { NewBody, PackedNewBody } from "./surface-files";
import { WorkerClient } from "./worker-client";

/** The features of a solid, and the body that they replace or become. */
export interface SolidRequest {
  readonly features: readonly SolidFeature[];
  /** What is kept of the body: its id, its name, and the ids and names of patches of the same origin. */
  readonly body: Pick<ProjectBody, "id" | "name"> & Pick<Partial<ProjectBody>, "patches">;
  /** Id of the first patch that is new. */
  readonly nextPatchId: number;
}

/** What features have given. */
export interface SolidAnswer<Body> {
  /** Null if they give no solid. */
  readonly made: Body | null;
  readonly edges: readonly Pick<EdgeLine, "name" | "faces">[];
  readonly failures: readonly FeatureFailure[];
}

export interface SolidProtocol {
  readonly evaluate: { readonly argument: SolidRequest; readonly answer: SolidAnswer<PackedNewBody> };
  /** What the solid of features is as lines and patches. */
  readonly draw: { readonly argument: readonly SolidFeature[]; readonly answer: DrawnSolid };
  /** The solids of a CAD file, with the names and colours of their faces. */
  readonly import: { readonly argument: PartFile; readonly answer: ImportedPart };
}

const startWorker = (): Worker =>
  new Worker(new URL("./solid-worker.ts", import.meta.url), { type: "module", name: "tetrafront-solids" });

/** Makes solids of features, in a worker that keeps the kernel. */
export class SolidClient {
  readonly #worker = new WorkerClient<SolidProtocol>(startWorker);

  async evaluate(request: SolidRequest): Promise<SolidAnswer<NewBody>> {
    const { made, ...answer } = await this.#worker.call("evaluate", request);
    if (made === null) return { made, ...answer };
    return { made: { body: await unpackedBody(made.packed), loaded: made.loaded }, ...answer };
  }

  draw(features: readonly SolidFeature[]): Promise<DrawnSolid> {
    return this.#worker.call("draw", features);
  }

  importPart(file: PartFile): Promise<ImportedPart> {
    return this.#worker.call("import", file);
  }

  /** Ends the worker, and with it a computation that takes too long. */
  dispose(): void {
    this.#worker.dispose();
  }
}

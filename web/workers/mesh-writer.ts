import type { MeshResult, Project } from "tetrafront";
import { handedOver, workerFailure } from "./transfer";

export interface WriteRequest extends Pick<MeshResult, "surface" | "volume"> {
  /** Names the patches. */
  readonly project: Project;
  readonly fileName: string;
}

export interface MeshFile {
  readonly fileName: string;
  readonly content: Blob;
}

export type WriteReply = { readonly files: readonly MeshFile[] } | { readonly failure: string };

/** The files that a mesh becomes in the format of this name, written in a worker. Rejects where it fails. */
export async function writeMeshFiles(
  mesh: MeshResult,
  project: Project,
  fileName: string,
): Promise<readonly MeshFile[]> {
  const worker = new Worker(new URL("./write-worker.ts", import.meta.url), {
    type: "module",
    name: "tetrafront-writer",
  });
  try {
    const reply = await new Promise<WriteReply>((resolve) => {
      worker.onmessage = ({ data }: MessageEvent<WriteReply>) => resolve(data);
      worker.onerror = (event) => {
        event.preventDefault();
        resolve({ failure: workerFailure(event) });
      };
      const surface = handedOver(mesh.surface);
      const volume = handedOver(mesh.volume);
      const request: WriteRequest = {
        surface: surface.copy,
        volume: volume.copy,
        project: { ...project, background: { nodes: [], tetrahedra: [] } },
        fileName,
      };
      worker.postMessage(request, [...surface.buffers, ...volume.buffers]);
    });
    if ("failure" in reply) throw new Error(reply.failure);
    return reply.files;
  } finally {
    worker.terminate();
  }
}

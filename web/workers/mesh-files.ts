import type { ElementOrder, FileGroup, MeshResult, Unit } from "tetrafront";
import type { Project } from "tetrafront/project";
import { copyForTransfer } from "./transfer";
import { callOnce } from "./worker-client";

export interface MeshFile {
  readonly fileName: string;
  readonly content: Blob;
}

/** Name of the file, whose extension selects the format, the order of its elements, and its length unit. */
export interface FileChoice {
  readonly fileName: string;
  readonly elementOrder: ElementOrder;
  /** The unit to which lengths are converted; null for that of the project. */
  readonly unit: Unit | null;
}

export interface MeshFileProtocol {
  readonly write: {
    readonly argument: Pick<MeshResult, "surface" | "volume"> & {
      /** Names the patches. */
      readonly project: Project;
      /** The regions of the file that the mesh was opened from; null if a run made it. */
      readonly regions: readonly FileGroup[] | null;
    } & FileChoice;
    readonly answer: readonly MeshFile[];
  };
}

const startWorker = (): Worker =>
  new Worker(new URL("./mesh-file-worker.ts", import.meta.url), {
    type: "module",
    name: "tetrafront-writer",
  });

/** Returns the files of a mesh in the format of the file name, written in a worker. Rejects if writing fails. */
export async function writeMeshFiles(
  mesh: MeshResult,
  project: Project,
  regions: readonly FileGroup[] | null,
  choice: FileChoice,
): Promise<readonly MeshFile[]> {
  const surface = await copyForTransfer(mesh.surface);
  const volume = await copyForTransfer(mesh.volume);
  const argument = {
    surface: surface.copy,
    volume: volume.copy,
    project: { ...project, background: { nodes: [], tetrahedra: [] } },
    regions,
    ...choice,
  };
  return callOnce<MeshFileProtocol, "write">(startWorker, "write", argument, [
    ...surface.buffers,
    ...volume.buffers,
  ]);
}

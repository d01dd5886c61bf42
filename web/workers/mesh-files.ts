import type { ElementOrder, Mesh, LengthUnit, MeshReport, MeshResult } from "tetrafront";
import { patchNames } from "tetrafront/internal";
import type { Project } from "tetrafront/project";
import { unitOf } from "../document/length-units";
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
  readonly unit: LengthUnit | null;
}

export interface MeshFileProtocol {
  readonly write: {
    readonly argument: {
      readonly mesh: Mesh;
      /** The unit of its lengths, if it is known. */
      readonly from: LengthUnit | undefined;
    } & FileChoice;
    readonly answer: readonly MeshFile[];
  };
  readonly report: {
    readonly argument: { readonly mesh: Mesh; readonly report: MeshReport };
    /** JSON text. */
    readonly answer: Blob;
  };
}

const startWorker = (): Worker =>
  new Worker(new URL("./mesh-file-worker.ts", import.meta.url), {
    type: "module",
    name: "tetrafront-writer",
  });

/**
 * Returns the files of a mesh in the format of the file name, written in a worker. The patches have the names that they have in
 * the project now. Rejects if writing fails.
 */
export async function writeMeshFiles(
  mesh: Mesh,
  project: Project,
  choice: FileChoice,
): Promise<readonly MeshFile[]> {
  const names = patchNames(project);
  const patches = mesh.patches.map((patch, p) => ({ ...patch, name: names[p] ?? patch.name }));
  const { copy, buffers } = await copyForTransfer({ ...mesh, patches });
  const argument = { mesh: copy, from: unitOf(project.units), ...choice };
  return callOnce<MeshFileProtocol, "write">(startWorker, "write", argument, buffers);
}

/** Returns the report of a mesh as `tetrafront mesh --report` writes it, made in a worker. */
export async function writeMeshReport({ mesh, report }: Pick<MeshResult, "mesh" | "report">): Promise<Blob> {
  const { copy, buffers } = await copyForTransfer(mesh);
  return callOnce<MeshFileProtocol, "report">(startWorker, "report", { mesh: copy, report }, buffers);
}

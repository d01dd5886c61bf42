import type { ReadResult } from "tetrafront";
import { readProject, writeProject, type Project } from "tetrafront/project";
import { bodiesOf } from "../document/entities";
import { manyTetrahedra } from "../document/engine-input";
import { documentGrid } from "../document/large-grid";
import { packedGrid, type PackedGrid } from "../document/packed-grid";
import { unpackedBodies, type PackedBody } from "./packed-bodies";
import { callOnce } from "./worker-client";

/** Up to this many bytes, reading a file in the page takes less time than starting a worker. */
const maxBytesInPage = 200_000;

/** Large background grids pass between page and worker as flat arrays, beside a project without nodes. */
export interface ProjectProtocol {
  readonly read: {
    readonly argument: Blob;
    readonly answer: {
      readonly result: ReadResult<Project>;
      readonly grid: PackedGrid | null;
      readonly bodies: readonly PackedBody[];
    };
  };
  readonly write: {
    readonly argument: { readonly project: Project; readonly grid: PackedGrid };
    readonly answer: Blob;
  };
}

const startWorker = (): Worker =>
  new Worker(new URL("./project-worker.ts", import.meta.url), { type: "module", name: "tetrafront-project" });

/** Reads a project file, a large one in a worker. Rejects if the file or the worker fails. */
export async function readProjectBlob(file: Blob): Promise<ReadResult<Project>> {
  if (file.size <= maxBytesInPage) return readProject(await file.text());
  const { result, grid, bodies } = await callOnce<ProjectProtocol, "read">(startWorker, "read", file);
  if (!result.success || grid === null) return result;
  const { value } = result;
  const background = { ...value.background, ...(await documentGrid(grid)) };
  const unpacked = await unpackedBodies(bodies);
  return { success: true, value: { ...value, ...(unpacked && { bodies: unpacked }), background } };
}

/** Length of the texts of bodies from which a worker writes the file. */
const manyCharacters = 1_000_000;

const hasLargeBodies = (project: Project): boolean =>
  bodiesOf(project).some(({ points, triangles }) => points.length + triangles.length > manyCharacters);

/** Returns the file of a project; if its background grid or a body is large, a worker writes the file. */
export async function writeProjectBlob(project: Project): Promise<Blob> {
  const { background } = project;
  if (background.tetrahedra.length <= manyTetrahedra && !hasLargeBodies(project)) return projectBlob(project);
  const drawn = { ...project, background: { ...background, nodes: [], tetrahedra: [] } };
  return callOnce<ProjectProtocol, "write">(startWorker, "write", {
    project: drawn,
    grid: packedGrid(background),
  });
}

export const projectBlob = (project: Project): Blob =>
  new Blob([writeProject(project)], { type: "application/json" });

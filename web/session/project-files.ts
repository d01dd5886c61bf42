import { readProject, writeProject, type Project, type ReadResult } from "tetrafront";
import { manyTetrahedra } from "../document/engine-input";
import { documentGrid } from "../document/large-grid";
import { packedGrid, type PackedGrid } from "../document/packed-grid";
import { workerFailure } from "../workers/transfer";

/** Files of at most so many bytes are read in the page: that takes less than a worker takes to start. */
const fewBytes = 200_000;

/** Of large grids only flat arrays pass between page and worker. */
export type ProjectRequest =
  | { readonly kind: "read"; readonly file: Blob }
  | { readonly kind: "write"; readonly project: Project; readonly grid: PackedGrid };

/** A project that was read comes without nodes and tetrahedra where there is a `grid`. */
export type ProjectReply =
  | { readonly kind: "read"; readonly result: ReadResult<Project>; readonly grid: PackedGrid | null }
  | { readonly kind: "written"; readonly file: Blob }
  | { readonly kind: "failure"; readonly failure: string };

/** Reads a project file; a large one in a worker. Rejects where it cannot be looked into at all. */
export async function readProjectIn(file: Blob): Promise<ReadResult<Project>> {
  if (file.size <= fewBytes) return readProject(await file.text());
  const { result, grid } = await asked("read", { kind: "read", file });
  if (!result.success || grid === null) return result;
  const { value } = result;
  return {
    success: true,
    value: { ...value, background: { ...value.background, ...(await documentGrid(grid)) } },
  };
}

/** The file of a project; of one with a large grid a worker writes it. */
export async function projectFileOf(project: Project): Promise<Blob> {
  const { background } = project;
  if (background.tetrahedra.length <= manyTetrahedra) return projectBlob(project);
  const drawn = { ...project, background: { ...background, nodes: [], tetrahedra: [] } };
  const { file } = await asked("written", { kind: "write", project: drawn, grid: packedGrid(background) });
  return file;
}

export const projectBlob = (project: Project): Blob =>
  new Blob([writeProject(project)], { type: "application/json" });

type Reply<K extends ProjectReply["kind"]> = Extract<ProjectReply, { kind: K }>;

async function asked<K extends "read" | "written">(kind: K, request: ProjectRequest): Promise<Reply<K>> {
  const worker = new Worker(new URL("../workers/project-worker.ts", import.meta.url), {
    type: "module",
    name: "tetrafront-project",
  });
  try {
    const reply = await new Promise<ProjectReply>((resolve) => {
      worker.onmessage = ({ data }: MessageEvent<ProjectReply>) => resolve(data);
      worker.onerror = (event) => {
        event.preventDefault();
        resolve({ kind: "failure", failure: workerFailure(event) });
      };
      worker.postMessage(request);
    });
    if (reply.kind === "failure") throw new Error(reply.failure);
    if (reply.kind !== kind) throw new Error(`The worker was asked for ${kind}, and has ${reply.kind}`);
    return reply as Reply<K>;
  } finally {
    worker.terminate();
  }
}

/** Reads or writes one project file, and tells. Its page starts one for every large file and ends it then. */
import { readProject } from "tetrafront";
import { packedGrid, unpackGrid } from "../document/packed-grid";
import { projectBlob, type ProjectReply, type ProjectRequest } from "../session/project-files";

/** The part of a worker's global scope used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(reply: ProjectReply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<ProjectRequest>) => void) | null;
}

const scope = globalThis as unknown as WorkerScope;

scope.onmessage = ({ data }) => {
  replyTo(data).then(
    (reply) => scope.postMessage(reply, buffersOf(reply)),
    (failure: unknown) => scope.postMessage({ kind: "failure", failure: String(failure) }, []),
  );
};

async function replyTo(request: ProjectRequest): Promise<ProjectReply> {
  if (request.kind === "write") {
    const { project, grid } = request;
    const background = { ...project.background, ...(await unpackGrid(grid)) };
    return { kind: "written", file: projectBlob({ ...project, background }) };
  }
  const result = readProject(await request.file.text());
  if (!result.success) return { kind: "read", result, grid: null };
  const { background } = result.value;
  const value = { ...result.value, background: { ...background, nodes: [], tetrahedra: [] } };
  return { kind: "read", result: { success: true, value }, grid: packedGrid(background) };
}

function buffersOf(reply: ProjectReply): ArrayBuffer[] {
  if (reply.kind !== "read" || reply.grid === null) return [];
  return [reply.grid.nodes.buffer as ArrayBuffer, reply.grid.tetrahedra.buffer as ArrayBuffer];
}

/** Writes one mesh to files, and tells. Its page starts one for every download and ends it then. */
import { fileMeshOf, writeMesh } from "tetrafront";
import type { WriteReply, WriteRequest } from "./mesh-writer";

/** The part of a worker's global scope used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(reply: WriteReply): void;
  onmessage: ((event: MessageEvent<WriteRequest>) => void) | null;
}

const scope = globalThis as unknown as WorkerScope;

scope.onmessage = ({ data }) => {
  write(data).then(
    (files) => scope.postMessage({ files }),
    (failure: unknown) =>
      scope.postMessage({ failure: failure instanceof Error ? failure.message : String(failure) }),
  );
};

/** Blobs are handed on without a copy, whatever their length. */
async function write({ surface, volume, project, fileName }: WriteRequest) {
  const files = await writeMesh(fileMeshOf({ surface, volume }, { project }), fileName);
  return files.map(({ fileName: name, bytes }) => ({ fileName: name, content: new Blob([bytes]) }));
}

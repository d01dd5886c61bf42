/** The worker that answers queries about the mesh on show, which would block the page. */
import type { Query, Reply, Request } from "./mesh-query-protocol";
import { MeshQueries, type DrawnFaces } from "./mesh-queries";

/** The part of a worker's global scope used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(reply: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

const scope = globalThis as unknown as WorkerScope;
const noMesh = { points: new Float64Array(), tetrahedra: new Uint32Array(), regions: new Uint32Array() };
let queries = new MeshQueries(noMesh);

scope.onmessage = ({ data }) => {
  if (data.kind === "mesh") {
    queries = new MeshQueries(data.mesh ?? noMesh);
    return;
  }
  try {
    answer(data.id, data.query);
  } catch (failure) {
    const message = failure instanceof Error ? failure.message : String(failure);
    scope.postMessage({ kind: "failure", id: data.id, message }, []);
  }
};

function answer(id: number, query: Query): void {
  switch (query.kind) {
    case "faces": {
      const faces = queries.facesOf(query.options);
      return scope.postMessage({ kind: "answer", id, answer: faces }, buffersOf(faces));
    }
    case "histogram": {
      const histogram = queries.histogram(query.measure, query.barCount);
      return scope.postMessage({ kind: "answer", id, answer: histogram }, []);
    }
  }
}

function buffersOf({ faces, onBoundary, corners, values }: DrawnFaces): ArrayBuffer[] {
  return [faces.buffer, onBoundary.buffer, corners.buffer, values.buffer];
}

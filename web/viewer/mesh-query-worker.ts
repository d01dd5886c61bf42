/** The worker that looks through the mesh on show: what takes more than a moment, the page asks for here. */
import type { Question, Reply, Request } from "./mesh-query-protocol";
import { Survey, type DrawnFaces } from "./mesh-queries";

/** The part of a worker's global scope used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(reply: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

const scope = globalThis as unknown as WorkerScope;
const noMesh = { points: new Float64Array(), tetrahedra: new Uint32Array(), regions: new Uint32Array() };
let survey = new Survey(noMesh);

scope.onmessage = ({ data }) => {
  if (data.kind === "mesh") {
    survey = new Survey(data.mesh ?? noMesh);
    return;
  }
  try {
    answer(data.id, data.question);
  } catch (failure) {
    const message = failure instanceof Error ? failure.message : String(failure);
    scope.postMessage({ kind: "failure", id: data.id, message }, []);
  }
};

function answer(id: number, question: Question): void {
  switch (question.kind) {
    case "faces": {
      const faces = survey.facesOf(question.look);
      return scope.postMessage({ kind: "answer", id, answer: faces }, buffersOf(faces));
    }
    case "histogram": {
      const histogram = survey.histogram(question.measure, question.barCount);
      return scope.postMessage({ kind: "answer", id, answer: histogram }, []);
    }
  }
}

function buffersOf({ faces, onBoundary, corners, values }: DrawnFaces): ArrayBuffer[] {
  return [faces.buffer, onBoundary.buffer, corners.buffer, values.buffer];
}

/** The worker that answers queries about the shown mesh; in the page, they would block it. */
import { serveCalls } from "../../workers/serve-calls";
import { MeshQueries } from "./mesh-queries";
import type { MeshQueryProtocol } from "./mesh-query-protocol";

const noMesh = {
  mesh: { points: new Float64Array(), tetrahedra: new Uint32Array(), tetrahedronRegion: new Uint32Array() },
};
let queries = new MeshQueries(noMesh);

serveCalls<MeshQueryProtocol>({
  setMesh: (mesh) => {
    queries = new MeshQueries(mesh ?? noMesh);
    return { answer: null };
  },
  faces: (options) => {
    const answer = queries.facesOf(options);
    const { faces, onBoundary, corners, values } = answer;
    return { answer, transfer: [faces.buffer, onBoundary.buffer, corners.buffer, values.buffer] };
  },
  tree: async (corners) => {
    // Load the library on demand: it is large, and no picture needs it.
    const { buildTree } = await import("../triangle-tree");
    const answer = buildTree(corners);
    return { answer, transfer: answer.roots };
  },
  histogram: ({ measure, space, barCount }) => ({ answer: queries.histogram(measure, space, barCount) }),
});

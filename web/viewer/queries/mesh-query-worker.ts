/** The worker that answers queries about the shown mesh; in the page, they would block it. */
import { serveCalls } from "../../workers/serve-calls";
import { cutToElement } from "../cut-to-element";
import { MeshQueries, type QueriedMesh } from "./mesh-queries";
import type { MeshQueryProtocol, PictureSize } from "./mesh-query-protocol";

const noMesh = {
  mesh: { points: new Float64Array(), tetrahedra: new Uint32Array(), tetrahedronRegion: new Uint32Array() },
};
let shown: QueriedMesh = noMesh;
let queries = new MeshQueries(shown);

serveCalls<MeshQueryProtocol>({
  setMesh: (mesh) => {
    shown = mesh ?? noMesh;
    queries = new MeshQueries(shown);
    return { answer: null };
  },
  setField: (field) => {
    queries.setField(field);
    return { answer: null };
  },
  // What few meshes need is loaded on demand.
  isosurface: async ({ level, origin }) => {
    const { mesh, values } = queries.drawnField;
    const { isosurface } = await import("./field-shapes");
    const answer = isosurface(mesh, values, level, origin);
    return { answer, transfer: [answer.buffer] };
  },
  faces: async (options) => {
    const asked = queries;
    const isDivided = options.byField === true && options.cut !== null;
    const answer = asked.facesOf(options, isDivided ? (await import("./smooth-cut")).cutSmoothly : null);
    const { faces, onBoundary, corners, shares, values } = answer;
    const arrays = [faces, onBoundary, corners, shares, values];
    return { answer, transfer: arrays.map(({ buffer }) => buffer) };
  },
  cut: ({ element, toEye }) => ({ answer: cutToElement(shown.mesh, element, toEye) }),
  picture: async ({ view, size }) => ({ answer: await smallPicture(view, size) }),
  tree: async (corners) => {
    // Load the library on demand: it is large, and no picture needs it.
    const { buildTree } = await import("../triangle-boxes");
    const answer = buildTree(corners);
    return { answer, transfer: answer.roots };
  },
  histogram: ({ measure, space, barCount }) => ({ answer: queries.histogram(measure, space, barCount) }),
});

/** Returns the middle of a view, as large as it fits. */
function smallPicture(view: ImageBitmap, { width, height }: PictureSize): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  const paper = canvas.getContext("2d");
  if (!paper) throw new Error("The browser offers no canvas");
  const scale = Math.max(width / view.width, height / view.height);
  const [across, down] = [scale * view.width, scale * view.height];
  paper.imageSmoothingQuality = "high";
  paper.drawImage(view, (width - across) / 2, (height - down) / 2, across, down);
  view.close();
  return canvas.convertToBlob({ type: "image/webp", quality: 0.85 });
}

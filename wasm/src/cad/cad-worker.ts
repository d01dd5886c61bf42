/** Worker that reads one CAD file. It is terminated afterwards, so each file gets a new instance of the library. */
import { cadPort } from "#cad-port";
import { crashOf, startFailure } from "./crash.js";
import { type CadKernel, readTriangulatedModel } from "./kernel.js";
import { numbersOf } from "./model-numbers.js";
import { QUIET, readByOpenCascade } from "./opencascade.js";
import type { CadReply, CadRequest } from "./protocol.js";

cadPort.onRequest((request) => void answer(request));

async function answer(request: CadRequest): Promise<void> {
  const reply = request.wants === "faces" ? await trueFaces(request) : await triangles(request);
  cadPort.post(reply, buffersOf(reply));
}

function triangles(request: CadRequest): Promise<CadReply> {
  const load = async () => {
    const { create, options } = await cadPort.library(request.library);
    const library = await create({ ...QUIET, ...options });
    cadPort.post({ kind: "loaded" }, []);
    return library;
  };
  return readByOpenCascade(load, request);
}

async function trueFaces({ format, bytes, deflection }: CadRequest): Promise<CadReply> {
  if (format === "iges") return { kind: "rejected" };
  let kernel: CadKernel;
  try {
    if (cadPort.kernel === undefined) throw new Error("it is not available here");
    kernel = await cadPort.kernel();
    cadPort.post({ kind: "loaded" }, []);
  } catch (failure) {
    return startFailure(failure);
  }
  try {
    const loaded = () => Promise.resolve(kernel);
    const read = await readTriangulatedModel(loaded, { format, bytes, fileName: "" }, deflection);
    return { kind: "faces", faces: { ...read.triangles, numbers: numbersOf(read.model) } };
  } catch (failure) {
    return crashOf(failure);
  }
}

function buffersOf(reply: CadReply): ArrayBuffer[] {
  if (reply.kind === "faces") {
    const { points, parameters, triangles: corners, faces, numbers } = reply.faces;
    return [points, parameters, corners, faces, numbers].map(({ buffer }) => buffer as ArrayBuffer);
  }
  if (reply.kind !== "read") return [];
  return reply.shapes.flatMap(({ points, triangles: corners }) => [
    points.buffer as ArrayBuffer,
    corners.buffer as ArrayBuffer,
  ]);
}

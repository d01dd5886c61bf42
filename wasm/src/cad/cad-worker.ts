/** Worker that reads one CAD file. It is terminated afterwards, so each file gets a new instance of the library. */
import { cadPort } from "#cad-port";
import { cadShapesOf } from "./cad-shapes.js";
import { crashOf } from "./crash.js";
import { fileTexts, triangulatedTexts } from "./kernel.js";
import type { CadKernel } from "./kernel-classes.js";
import { QUIET, readByOpenCascade } from "./opencascade.js";
import type { CadReply, CadRequest } from "./protocol.js";

cadPort.onRequest((request) => void answer(request));

async function answer(request: CadRequest): Promise<void> {
  const kernel = request.format === "iges" ? undefined : await loadedKernel(request);
  const reply = kernel === undefined ? await readByLibrary(request) : readByKernel(kernel, request);
  cadPort.post(reply, buffersOf(reply));
}

/** Returns the kernel; undefined where it is not installed or not served. */
async function loadedKernel({ library }: CadRequest): Promise<CadKernel | undefined> {
  try {
    const kernel = await cadPort.kernel(library);
    if (kernel !== undefined) cadPort.post({ kind: "loaded" }, []);
    return kernel;
  } catch {
    return undefined;
  }
}

function readByKernel(kernel: CadKernel, request: CadRequest): CadReply {
  const { format, bytes, deflection, sharesFaces } = request;
  if (format === "iges") return { kind: "rejected" };
  try {
    const onSharing = sharesFaces ? () => cadPort.post({ kind: "sharing" }, []) : undefined;
    const { bare: given, keepsBare } = request;
    const texts = given
      ? { ...triangulatedTexts(kernel, given, deflection), bare: undefined }
      : fileTexts(kernel, { format, bytes }, deflection, { onSharing, keepsBare });
    if (texts === undefined) return { kind: "rejected" };
    const step = format === "step" ? new TextDecoder("latin1").decode(bytes) : undefined;
    const shapes = cadShapesOf(texts, step);
    return { kind: "read", shapes, bare: texts.bare };
  } catch (failure) {
    return crashOf(failure);
  }
}

function readByLibrary(request: CadRequest): Promise<CadReply> {
  const load = async () => {
    const { create, options } = await cadPort.library(request.library);
    const library = await create({ ...QUIET, ...options });
    cadPort.post({ kind: "loaded" }, []);
    return library;
  };
  return readByOpenCascade(load, request);
}

function buffersOf(reply: CadReply): ArrayBuffer[] {
  if (reply.kind !== "read") return [];
  const arrays = reply.shapes.flatMap(({ points, triangles, trueFaces }) => {
    const own = [points, triangles];
    if (trueFaces === undefined) return own;
    const { parameters, triangles: near, faces, numbers } = trueFaces;
    return [...own, parameters, near, faces, numbers];
  });
  return arrays.map(({ buffer }) => buffer as ArrayBuffer);
}

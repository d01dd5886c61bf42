/** Worker that reads one CAD file. It is terminated afterwards, so each file gets a new instance of the library. */
import { cadPort } from "#cad-port";
import { QUIET, readByOpenCascade } from "./opencascade.js";
import type { CadReply, CadRequest } from "./protocol.js";

cadPort.onRequest((request) => void answer(request));

async function answer(request: CadRequest): Promise<void> {
  const load = async () => {
    const { create, options } = await cadPort.library(request.library);
    const library = await create({ ...QUIET, ...options });
    cadPort.post({ kind: "loaded" }, []);
    return library;
  };
  const reply = await readByOpenCascade(load, request);
  cadPort.post(reply, buffersOf(reply));
}

function buffersOf(reply: CadReply): ArrayBuffer[] {
  if (reply.kind !== "read") return [];
  return reply.shapes.flatMap(({ points, triangles }) => [
    points.buffer as ArrayBuffer,
    triangles.buffer as ArrayBuffer,
  ]);
}

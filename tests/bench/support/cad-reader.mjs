// Worker that reads CAD files one after the other, as the package does. `workerData`: the compiled library, because compiling
// takes longer than reading.
import { createRequire } from "node:module";
import { parentPort, workerData } from "node:worker_threads";
import { QUIET, readByOpenCascade } from "../../../wasm/dist/cad/opencascade.js";

const create = createRequire(import.meta.url)("occt-import-js");
const deflection = { distance: Math.sqrt(3) / 5000, isRelative: true, angle: 0.1 };

function instantiateWasm(imports, onDone) {
  void WebAssembly.instantiate(workerData, imports).then((instance) => onDone(instance, workerData));
  return {};
}

const library = create({ ...QUIET, instantiateWasm });

parentPort.on("message", async ({ format, bytes }) => {
  const request = { format, bytes, deflection, library: undefined };
  parentPort.postMessage(await readByOpenCascade(() => library, request));
});

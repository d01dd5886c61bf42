import { receiveWatched, type LifeRequest } from "../calls/worker-life.js";
import type { CadPort } from "./cad-port.js";
import { importKernel } from "./kernel-browser.js";
import type { CreateOpenCascade } from "./opencascade.js";
import type { CadRequest } from "./protocol.js";

/** The part of a worker's global scope that is used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(message: unknown, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<CadRequest | LifeRequest>) => void) | null;
  define?: unknown;
}

const scope = globalThis as unknown as WorkerScope;

export const cadPort: CadPort = {
  onRequest: (handle) => {
    const receive = receiveWatched(handle, (reply) => scope.postMessage(reply, []));
    scope.onmessage = ({ data }) => receive(data);
  },
  post: (reply, transfer) => scope.postMessage(reply, [...transfer]),
  library: async ({ script, wasm }) => {
    const create = await definedBy(script);
    return { create, options: { locateFile: () => wasm } };
  },
  kernel: async ({ kernel }) => kernel && importKernel(kernel),
};

/** Runs the library's script, which is not a module: it defines itself as an AMD module. */
async function definedBy(script: string): Promise<CreateOpenCascade> {
  let create: CreateOpenCascade | undefined;
  const define = (_dependencies: unknown, make: () => CreateOpenCascade) => {
    create = make();
  };
  scope.define = Object.assign(define, { amd: true });
  await import(/* @vite-ignore */ /* webpackIgnore: true */ script);
  if (create === undefined) throw new Error(`${script} is not occt-import-js`);
  return create;
}

/**
 * Loads the compiled module "plane", which fills polygons by the front of a patch. It runs where it is loaded, also in the thread of
 * a page: it is small, and a fill of a few hundred triangles takes less time than a message to a worker and back.
 */
import { compile } from "#compile";
import { instantiated } from "./instantiated.js";
import type { MainModule as PlaneEngine } from "./plane.js";

export type { PlaneEngine };
export type EngineFill = ReturnType<NonNullable<ReturnType<PlaneEngine["fillPlane"]>>["result"]>;

/** Rejects if WebAssembly or a file is missing. */
export async function loadPlane(): Promise<PlaneEngine> {
  const [{ default: createPlane }, module] = await Promise.all([
    import("./plane.js"),
    compile(new URL("./plane.wasm", import.meta.url)),
  ]);
  return instantiated(createPlane, module);
}

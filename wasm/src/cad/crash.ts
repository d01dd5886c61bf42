/** Distinguishes files in which OpenCascade fails from workers without a script or memory. */
import type { CadCrash } from "./protocol.js";

const MEMORY = /out of memory|OOM|enlarge memory|allocation failed|array length|ERR_WORKER_OUT_OF_MEMORY/i;
const MODULE = /MODULE_NOT_FOUND/;

/** Returns what a failure during the reading of a file means. A C++ exception is thrown as a number, without a message. */
export function crashOf(failure: unknown): CadCrash {
  const message = failure instanceof Error ? failure.message : "an exception";
  const code = failure instanceof Error && "code" in failure ? String(failure.code) : "";
  const words = `${code} ${message}`;
  if (MODULE.test(code)) return { kind: "not-loaded", message };
  return { kind: MEMORY.test(words) ? "out-of-memory" : "failed", message };
}

/** Returns what it means that a worker or the library cannot be started. */
export function startFailure(failure: unknown): CadCrash {
  const crash = crashOf(failure);
  return crash.kind === "out-of-memory" ? crash : { ...crash, kind: "not-loaded" };
}

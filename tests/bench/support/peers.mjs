// Other meshers beside ours, where their Python packages are installed (tests/bench/peers/peers.py).
import { spawnSync } from "node:child_process";
import { fileURLToPath } from "node:url";
import { pythonProgram } from "../../../scripts/lib/python.mjs";
import { valuesOf } from "./engines.mjs";

const python = pythonProgram();
const script = fileURLToPath(new URL("../peers/peers.py", import.meta.url));
/** Netgen's front takes most of a minute for 100 k tetrahedra. */
const TIMEOUT_MS = 1000 * Number(process.env.TETRAFRONT_PEER_SECONDS ?? 900);

export const INSTALL = `${python} -m pip install numpy gmsh netgen-mesher tetgen`;

/** Names of the peers that can run; none where Python or numpy is missing. */
export function availablePeers() {
  const { status, stdout } = spawnSync(python, [script], { encoding: "utf8" });
  return status === 0 ? stdout.split("\n").filter(Boolean) : [];
}

/** What the peer made of the surface, or `{ failure }` in a few words. */
export function runPeer(name, file) {
  const { status, stdout, stderr, error } = spawnSync(python, [script, name, file], {
    encoding: "utf8",
    timeout: TIMEOUT_MS,
  });
  if (error) return { failure: error.code === "ETIMEDOUT" ? "ran out of time" : error.message };
  if (status !== 0) return { failure: stderr.trim().split("\n").pop() || `exit status ${status}` };
  // Some of them print words of their own first.
  return valuesOf(stdout.slice(stdout.indexOf("tetrahedra ")));
}

// Runs other meshers for comparison, if their Python packages are installed (tests/bench/peers/peers.py).
import { spawnSync } from "node:child_process";
import { tmpdir } from "node:os";
import { fileURLToPath } from "node:url";
import { pythonProgram } from "../../../scripts/lib/python.mjs";
import { valuesOf } from "./engines.mjs";

const python = pythonProgram();
const script = fileURLToPath(new URL("../peers/peers.py", import.meta.url));
/** Time limit per mesher. Netgen's front takes most of a minute for 100 000 tetrahedra. */
const TIMEOUT_MS = 1000 * Number(process.env.TETRAFRONT_PEER_SECONDS ?? 900);

export const INSTALL = `${python} -m pip install numpy gmsh netgen-mesher tetgen`;

export const INSTALL_PART_PEERS = `${python} -m pip install numpy gmsh tetgen pytetwild pyvista`;

/** Returns the names of the peers that can run; empty if Python or numpy is missing. */
export const availablePeers = () => namesOf([]);
export const availablePartPeers = () => namesOf(["parts"]);

/** Returns the command that installs the meshers of parts that are missing, or undefined if all can run. */
export function installMissingPartPeers() {
  const packages = namesOf(["missing-parts"]);
  return packages.length > 0 ? `${python} -m pip install ${packages.join(" ")}` : undefined;
}

/** Returns the peer's results for the surface, or `{ failure }` with a short reason. */
export const runPeer = (name, file) => resultOf([name, file]);
/** The same for a part in an STL file. */
export const runPartPeer = (name, file) => resultOf(["part", name, file]);

function namesOf(words) {
  const { status, stdout } = spawnSync(python, [script, ...words], { encoding: "utf8" });
  return status === 0 ? stdout.split("\n").filter(Boolean) : [];
}

function resultOf(words) {
  const { status, stdout, stderr, error } = spawnSync(python, [script, ...words], {
    encoding: "utf8",
    timeout: TIMEOUT_MS,
    // fTetWild leaves a file in the folder where it runs.
    cwd: tmpdir(),
  });
  if (error) return { failure: error.code === "ETIMEDOUT" ? "ran out of time" : error.message };
  if (status !== 0) return { failure: stderr.trim().split("\n").pop() || `exit status ${status}` };
  // Some peers print messages before their results.
  return valuesOf(stdout.slice(stdout.indexOf("tetrahedra ")));
}

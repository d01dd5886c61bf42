// Runs MMG's program mmg3d, which MMG3D names: by default the one in PATH.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { readMesh, writeMesh } from "tetrafront";

const mmg = process.env.MMG3D ?? "mmg3d";

export const hasMmg = spawnSync(mmg, ["-h"]).error === undefined;

export const INSTALL_MMG =
  "There is no mmg3d: pip install mmgpy into a virtual environment, and set MMG3D to its bin/mmg3d.";

/** No gradation, as in our adaptation: both follow the same metric. */
const OPTIONS = ["-v", "0", "-in", "in.mesh", "-sol", "in.sol", "-out", "out.mesh", "-hgrad", "-1"];
/** Runs a program and prints the processor times of the shell and of the program. */
const TIMED = '"$0" "$@"; status=$?; times; exit $status';

/** Adapts a mesh to the metric at its nodes. Returns the mesh and processor seconds, those of reading and writing included. */
export async function adaptByMmg(mesh) {
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-mmg-"));
  try {
    for (const { fileName, bytes } of await writeMesh(mesh, "in.mesh")) {
      writeFileSync(path.join(folder, fileName), bytes);
    }
    const run = spawnSync("sh", ["-c", TIMED, mmg, ...OPTIONS], { cwd: folder, encoding: "utf8" });
    if (run.status !== 0)
      throw new Error(`${mmg} failed: ${run.stdout.slice(-400)}${run.stderr.slice(-400)}`);
    const read = await readMesh(readFileSync(path.join(folder, "out.mesh")), { fileName: "out.mesh" });
    if (!read.success) throw new Error(read.errors[0].message);
    return { mesh: read.value, seconds: childSeconds(run.stdout) };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Parses the last line of `times`: user and system time of the program, as 1m2.3s. */
function childSeconds(text) {
  const times = [
    ...text
      .trim()
      .split("\n")
      .at(-1)
      .matchAll(/(\d+)m([\d.]+)s/g),
  ];
  return times.reduce((sum, [, minutes, seconds]) => sum + 60 * Number(minutes) + Number(seconds), 0);
}

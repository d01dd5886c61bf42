// node batch.mjs parts meshes: meshes every STL file of a folder into a VTU file in another one, with one process
// per core.
// `tetrafront mesh 'parts/*.stl' -o 'meshes/{name}.vtu'` does the same; this example shows how to write your own
// batch.
import { fork } from "node:child_process";
import { readdir } from "node:fs/promises";
import { availableParallelism } from "node:os";
import path from "node:path";
import { createMesher } from "tetrafront";
import { meshFile, writeMeshFile } from "tetrafront/node";

if (process.send === undefined) await main(process.argv[2], process.argv[3]);
else work();

/** Distributes the parts: a process requests the next part when it has finished one. */
async function main(folder, target) {
  const parts = (await readdir(folder)).filter((name) => name.endsWith(".stl")).sort();
  const reports = new Map();
  /** Starts a process; resolves when no part is left. A process that crashes is replaced by another one. */
  const handOut = () =>
    new Promise((resolve) => {
      const child = fork(import.meta.filename);
      let current;
      child.on("message", ({ part, ...report }) => {
        if (part !== undefined) reports.set(part, report);
        current = parts.find((name) => !reports.has(name));
        if (current === undefined) return child.disconnect();
        reports.set(current, { status: "under way" });
        child.send({ part: current, input: path.join(folder, current), output: target });
      });
      child.on("exit", (code, signal) => {
        if (current === undefined) return resolve();
        process.exitCode = 1;
        reports.set(current, { status: "crashed", message: `its process ended with ${signal ?? code}` });
        resolve(handOut());
      });
    });
  await Promise.all(Array.from({ length: Math.min(availableParallelism(), parts.length) }, handOut));
  for (const part of parts) console.log(part, JSON.stringify(reports.get(part)));
}

/** A child process uses one mesher for all its parts, so that the engine is compiled only once. */
function work() {
  const mesher = createMesher();
  process.on("message", async ({ part, input, output }) => {
    process.send({ part, ...(await meshed(await mesher, input, output)) });
  });
  process.on("disconnect", async () => (await mesher).dispose());
  process.send({});
}

async function meshed(mesher, input, output) {
  const made = await meshFile(input, { mesher });
  if (!made.success) return { status: made.report.status, message: made.message };
  await writeMeshFile(made.mesh, path.join(output, `${path.basename(input, ".stl")}.vtu`));
  return { status: made.report.status, tetrahedra: made.report.tetrahedra };
}

// node batch.mjs parts meshes: every STL of one folder becomes a VTU in another, one process per core.
// `tetrafront mesh 'parts/*.stl' -o 'meshes/{name}.vtu'` does the same; here is how to do your own.
import { fork } from "node:child_process";
import { createReadStream } from "node:fs";
import { readdir, writeFile } from "node:fs/promises";
import { availableParallelism } from "node:os";
import path from "node:path";
import { createMesher, fileMeshOf, readSurface, writeMesh } from "tetrafront";

if (process.send === undefined) await main(process.argv[2], process.argv[3]);
else work();

/** The parent hands out parts: a process asks for the next when it is through with one. */
async function main(folder, target) {
  const parts = (await readdir(folder)).filter((name) => name.endsWith(".stl")).sort();
  const reports = new Map();
  await Promise.all(
    Array.from({ length: Math.min(availableParallelism(), parts.length) }, () => {
      const child = fork(import.meta.filename);
      child.on("message", ({ part, ...report }) => {
        if (part !== undefined) reports.set(part, report);
        const next = parts.find((name) => !reports.has(name));
        if (next === undefined) return child.disconnect();
        reports.set(next, { status: "under way" });
        child.send({ part: next, input: path.join(folder, next), output: target });
      });
      return new Promise((resolve) => child.on("exit", resolve));
    }),
  );
  for (const part of parts) console.log(part, JSON.stringify(reports.get(part)));
}

/** A child keeps its mesher from part to part: the engine is compiled once. */
function work() {
  const mesher = createMesher();
  process.on("message", async ({ part, input, output }) => {
    process.send({ part, ...(await meshed(await mesher, input, output)) });
  });
  process.on("disconnect", async () => (await mesher).dispose());
  process.send({});
}

async function meshed(mesher, input, output) {
  const read = await readSurface(createReadStream(input), { fileName: input });
  if (!read.success) return { status: "unreadable", message: read.problems[0].message };
  const mesh = await mesher.fillSurface(read.value);
  const { status, tetrahedra } = mesh.report;
  if (status !== "done") return { status, message: mesh.report.diagnostics[0]?.message };
  const name = path.join(output, `${path.basename(input, ".stl")}.vtu`);
  for (const { fileName, bytes } of await writeMesh(fileMeshOf(mesh), name)) await writeFile(fileName, bytes);
  return { status, tetrahedra };
}

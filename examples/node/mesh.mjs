// node mesh.mjs part.stl part.vtu
import { createReadStream } from "node:fs";
import { writeFile } from "node:fs/promises";
import { createMesher, fileMeshOf, readSurface, writeMesh } from "tetrafront";

const [, , input, output] = process.argv;
const read = await readSurface(createReadStream(input), { fileName: input });
if (!read.success) throw new Error(read.errors[0].message);

const mesher = await createMesher();
const mesh = await mesher.fillSurface(read.value);
const { status, tetrahedra, dihedral, diagnostics } = mesh.report;
for (const { message, remedy } of diagnostics) console.error(`${message}. ${remedy}`);
if (status === "done") {
  const files = await writeMesh(fileMeshOf(mesh, { surface: read.value }), output);
  for (const { fileName, bytes } of files) await writeFile(fileName, bytes);
  console.log(
    `${tetrahedra} tetrahedra, dihedral angles ${dihedral.min.toFixed(1)}° to ${dihedral.max.toFixed(1)}°`,
  );
}
mesher.dispose();
process.exitCode = status === "done" ? 0 : 1;

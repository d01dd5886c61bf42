// node mesh.mjs part.stl part.vtu: fills a closed surface with tetrahedra.
import { createMesher, fileMeshOf } from "tetrafront";
import { readSurfaceFile, writeMeshFile } from "tetrafront/node";

const [, , input, output] = process.argv;
const read = await readSurfaceFile(input);
if (!read.success) throw new Error(read.errors[0].message);

const mesher = await createMesher();
const mesh = await mesher.fillSurface(read.value);
const { status, tetrahedra, dihedral, diagnostics } = mesh.report;
for (const { message, remedy } of diagnostics) console.error(`${message}. ${remedy}`);
if (status === "done") {
  await writeMeshFile(fileMeshOf(mesh, { surface: read.value }), output);
  console.log(
    `${tetrahedra} tetrahedra, dihedral angles ${dihedral.min.toFixed(1)}° to ${dihedral.max.toFixed(1)}°`,
  );
}
mesher.dispose();
process.exitCode = status === "done" ? 0 : 1;

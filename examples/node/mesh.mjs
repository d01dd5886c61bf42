// node mesh.mjs part.stl part.vtu: fills a closed surface with tetrahedra.
import { meshFile, writeMeshFile } from "tetrafront/node";

const [, , input, output] = process.argv;
const made = await meshFile(input);
for (const note of made.notes) console.error(note);
if (made.success) {
  const { tetrahedra, dihedral } = made.report;
  await writeMeshFile(made.mesh, output);
  console.log(
    `${tetrahedra} tetrahedra, dihedral angles ${dihedral.min.toFixed(1)}° to ${dihedral.max.toFixed(1)}°`,
  );
} else {
  console.error(made.message);
  process.exitCode = 1;
}

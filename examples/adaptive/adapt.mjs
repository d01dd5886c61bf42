// Adapts a mesh to a function that stands for a solver, in Node: an async function from the mesh to values at its nodes.
//   npm install tetrafront && node adapt.mjs part.stl adapted.vtu
import { readFile, writeFile } from "node:fs/promises";
import { createMesher, readSurface, writeMesh } from "tetrafront";

const [, , input = "part.stl", output = "adapted.vtu"] = process.argv;
const read = await readSurface(await readFile(input), { fileName: input });
if (!read.success) throw new Error(read.errors[0].message);

/** A solver would compute the values; these jump across a sphere around the origin. */
async function solve({ points }) {
  const values = new Float64Array(points.length / 3);
  for (let node = 0; node < values.length; node++) {
    const [x, y, z] = points.subarray(3 * node, 3 * node + 3);
    values[node] = Math.tanh(10 * (Math.hypot(x, y, z) - 0.7));
  }
  return [{ name: "u", components: 1, values }];
}

const mesher = await createMesher();
const options = { cycles: 2, elements: 3000 };
for await (const { cycle, mesh, next, estimatedErrors } of mesher.adapt(read.value, solve, options)) {
  const { tetrahedra, unitEdges } = next.after;
  const error = estimatedErrors[0].toExponential(2);
  console.log(
    `cycle ${cycle}: ${mesh.tetrahedra.length / 4} elements, estimated error ${error}; next: ${tetrahedra} elements, ${(100 * unitEdges).toFixed(1)} % unit edges`,
  );
  for (const { bytes } of await writeMesh(next.mesh, output)) await writeFile(output, bytes);
}
mesher.dispose();

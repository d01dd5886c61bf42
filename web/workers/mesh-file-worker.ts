/** Writes a mesh to files. The page starts one worker per download and ends it afterwards. */
import { writeMesh } from "tetrafront";
import { lengthConverter } from "../document/length-units";
import type { MeshFileProtocol } from "./mesh-files";
import { serveCalls } from "./serve-calls";

serveCalls<MeshFileProtocol>({
  write: async ({ mesh, from, fileName, elementOrder, unit }) => {
    if (unit !== null && from !== undefined) {
      const convert = lengthConverter(from, unit);
      for (const values of [mesh.points, mesh.curvedEdges?.middles]) {
        values?.forEach((x, i) => (values[i] = convert(x)));
      }
    }
    const files = await writeMesh(mesh, fileName, { elementOrder });
    // Blobs pass to the page without a copy, whatever their length.
    return {
      answer: files.map(({ fileName: name, bytes }) => ({ fileName: name, content: new Blob([bytes]) })),
    };
  },
});

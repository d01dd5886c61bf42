/** Writes a mesh to files. The page starts one worker per download and ends it afterwards. */
import { fileMeshOf, writeMesh } from "tetrafront";
import { lengthConverter, unitOf } from "../document/length-units";
import type { MeshFileProtocol } from "./mesh-files";
import { serveCalls } from "./serve-calls";

serveCalls<MeshFileProtocol>({
  write: async ({ surface, volume, project, regions, fileName, elementOrder, unit }) => {
    const from = unitOf(project.units);
    if (unit !== null && from !== undefined) {
      const convert = lengthConverter(from, unit);
      for (const { points } of [surface, volume]) points.forEach((x, i) => (points[i] = convert(x)));
    }
    const mesh = fileMeshOf({ surface, volume }, { project });
    const files = await writeMesh({ ...mesh, regions: regions ?? mesh.regions }, fileName, { elementOrder });
    // Blobs pass to the page without a copy, whatever their length.
    return {
      answer: files.map(({ fileName: name, bytes }) => ({ fileName: name, content: new Blob([bytes]) })),
    };
  },
});

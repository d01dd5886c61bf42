/** Writes a mesh to files. The page starts one worker per download and ends it afterwards. */
import { fileMeshOf, writeMesh } from "tetrafront";
import type { MeshFileProtocol } from "./mesh-files";
import { serveCalls } from "./serve-calls";

serveCalls<MeshFileProtocol>({
  write: async ({ surface, volume, project, regions, fileName, elementOrder }) => {
    const mesh = fileMeshOf({ surface, volume }, { project });
    const files = await writeMesh({ ...mesh, regions: regions ?? mesh.regions }, fileName, { elementOrder });
    // Blobs pass to the page without a copy, whatever their length.
    return {
      answer: files.map(({ fileName: name, bytes }) => ({ fileName: name, content: new Blob([bytes]) })),
    };
  },
});

/**
 * Reads STEP, IGES and BREP files by OpenCascade, which triangulates their faces. Each solid becomes a region, each
 * face a patch, in millimetres.
 */
import { askForCad, notLoadedRemedy } from "../cad/cad-client.js";
import type { CadFormat, Deflection } from "../cad/protocol.js";
import { inSteps } from "../calls/yielder.js";
import type { FileMesh } from "../mesh/file-mesh.js";
import { allBytes, type ByteSource } from "./byte-source.js";
import type { MeshReader } from "./file-format.js";
import { ReadFailure } from "./read-result.js";
import { surfaceOfShapes } from "./shape-surface.js";

/**
 * The distance is at most 1/5000 of the diagonal of each part, far below the remesher's tolerance of 1/700; the mean
 * side of a box is at most its diagonal / √3. With this angle, a circle has 63 edges and loses 0.17 % of its area.
 */
const DEFLECTION: Deflection = { distance: Math.sqrt(3) / 5000, isRelative: true, angle: 0.1 };

const NAMES: Readonly<Record<CadFormat, string>> = { step: "STEP", iges: "IGES", brep: "BREP" };

export const readStep = readerOf("step");
export const readIges = readerOf("iges");
export const readBrep = readerOf("brep");

function readerOf(format: CadFormat): MeshReader {
  return async (source: ByteSource, { signal, onWork }): Promise<FileMesh> => {
    const bytes = await allBytes(source);
    if (bytes.length === 0) throw new ReadFailure(EMPTY);
    const reply = await askForCad({ format, bytes, deflection: DEFLECTION }, signal);
    const remedy = `Export the part again as ${NAMES[format]}, or in another format; the file is damaged or not ${NAMES[format]}.`;
    switch (reply.kind) {
      case "not-loaded": {
        const message = `${NAMES[format]} files need the library occt-import-js, which could not be loaded: ${reply.message}`;
        throw new ReadFailure({ code: "missing-library", message, remedy: notLoadedRemedy });
      }
      case "rejected":
        throw new ReadFailure({ message: `OpenCascade cannot read the file as ${NAMES[format]}`, remedy });
      case "failed":
        throw new ReadFailure({ message: `OpenCascade failed in the file: ${reply.message}`, remedy });
      case "read": {
        const shapes = reply.shapes.filter(({ triangles }) => triangles.length > 0);
        if (shapes.length === 0)
          throw new ReadFailure({
            code: "no-triangles",
            message: `the ${NAMES[format]} file contains no solids and no faces`,
            remedy: "Export the part as solids.",
          });
        const mesh = await inSteps(surfaceOfShapes(shapes), signal);
        onWork?.(1);
        return format === "brep" ? mesh : { ...mesh, unit: "mm" };
      }
    }
  };
}

const EMPTY = { code: "empty-file", message: "the file is empty", remedy: "Export the part again." } as const;

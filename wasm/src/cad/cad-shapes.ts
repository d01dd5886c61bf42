/** The solids of a file as triangles and as true faces, from the text in which the kernel hands them out. */
import { partsOfBrep } from "./brep-model.js";
import { modelTrianglesOf, trianglesOf } from "./brep-triangles.js";
import { numbersOf } from "./model-numbers.js";
import type { CadShape } from "./protocol.js";
import { looksOf } from "./step-looks.js";

/**
 * Returns the solids of a shape, and faces that bound none. `step`: text of the STEP file of the shape, which has the names and
 * colours. Throws a CadFileError if the text is damaged. O(bytes).
 */
export function cadShapesOf(brep: string, step: string | undefined): CadShape[] {
  const parts = partsOfBrep(brep, "");
  const looks =
    step === undefined
      ? []
      : looksOf(
          step,
          parts.map(({ kinds }) => kinds),
        );
  return parts.map(({ model, faces }, p) => {
    const { solid, faces: ofFaces = [] } = looks[p] ?? {};
    const made = trianglesOf(faces);
    const { points, triangles, counts } = made;
    return {
      name: solid?.name ?? "",
      hasOwnName: false,
      points,
      triangles,
      faces: counts.map((count, f) => {
        const { name = "", color } = ofFaces[f] ?? {};
        return { triangles: count, color, name: ownName(name) };
      }),
      trueFaces: {
        ...modelTrianglesOf(faces, made),
        numbers: numbersOf(model),
        faceCount: model.faces.length,
        missing: model.notes,
      },
    };
  });
}

/** Returns the name of a face; undefined for what programs write where it has none. */
const ownName = (name: string): string | undefined => (/^(NONE)?$/i.test(name) ? undefined : name);

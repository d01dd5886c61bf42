/** The solids of a file as triangles and as true faces, from the text in which the kernel hands them out. */
import { kindsOfBrep, partsOfBrep } from "./brep-model.js";
import { modelTrianglesOf, trianglesOf } from "./brep-triangles.js";
import { numbersOf } from "./model-numbers.js";
import type { CadShape, FileTexts } from "./protocol.js";
import { looksOf, ownName } from "./step-looks.js";

/**
 * Returns the solids of a shape, and faces that bound none. Solids that share faces have those of the file, in parts. `step`: text of
 * the STEP file of the shape, which has the names and colours. Throws a CadFileError if a text is damaged. O(bytes).
 */
export function cadShapesOf({ text, given }: FileTexts, step: string | undefined): CadShape[] {
  const parts = partsOfBrep(text, "");
  const kinds = given === undefined ? parts.map((part) => part.kinds) : kindsOfBrep(given.text, "");
  const looks = step === undefined ? [] : looksOf(step, kinds);
  return parts.map(({ model, faces: pieces }, p) => {
    const { solid, faces: ofFaces = [] } = looks[p] ?? {};
    const origins = given?.origins[p] ?? [];
    const originOf = (piece: number) => origins[piece] ?? piece;
    const order = [...pieces.keys()].sort((a, b) => originOf(a) - originOf(b) || a - b);
    const faces = order.flatMap((piece) => pieces[piece] ?? []);
    const made = trianglesOf(faces);
    const { points, triangles, counts } = made;
    const triangleCounts = (kinds[p] ?? []).map(() => 0);
    order.forEach((piece, k) => {
      const face = originOf(piece);
      triangleCounts[face] = (triangleCounts[face] ?? 0) + (counts[k] ?? 0);
    });
    return {
      name: solid?.name ?? "",
      hasOwnName: false,
      points,
      triangles,
      faces: triangleCounts.map((count, f) => {
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

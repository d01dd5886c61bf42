/** Numbers of the whole surface, in place of those of a part of it that was treated by itself. */
import { withSentences } from "../diagnostics/describe.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import { SENTENCES } from "../diagnostics/sentences.js";
import type { SolidsPart } from "../formats/solid-units.js";
import { NO_ORIGIN } from "../generated/constants.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { Mesh } from "../mesh/mesh.js";
import { chainedOrigins, surfaceNamer } from "./surface-numbers.js";

/** Per triangle and per node of a part: its index in the whole surface. */
export type WholeNumbers = Pick<SolidsPart, "wholeTriangles" | "wholeNodes">;

/** Returns what became of a part with the origins of its triangles and nodes in the whole surface. */
export function withWholeOrigins(
  { wholeTriangles, wholeNodes }: WholeNumbers,
  { origin, nodeOrigin, ...surface }: Mesh,
): Mesh {
  return {
    ...surface,
    origin: origin === undefined ? wholeTriangles : chainedOrigins(wholeTriangles, origin),
    nodeOrigin: nodeOrigin === undefined ? wholeNodes : chainedOrigins(wholeNodes, nodeOrigin),
  };
}

/** Returns a diagnostic of a part; its triangles and nodes are named by their numbers in the whole surface. */
export function inWhole({ wholeTriangles, wholeNodes }: WholeNumbers, found: Diagnostic): Diagnostic {
  const name = surfaceNamer({ origin: wholeTriangles, nodeOrigin: wholeNodes });
  const entities = found.entities.map((entity) => {
    const { kind, index, label } = entity;
    // Those that a repair has made are not in the whole surface.
    return label === nameByIndex(kind, index).label ? name(kind, index) : entity;
  });
  const isRenamed = entities.some(({ index }, e) => index !== found.entities[e]?.index);
  if (!isRenamed || !(found.code in SENTENCES)) return found;
  // The compiler cannot infer the union over all codes from the type for one code.
  return withSentences({ ...found, entities } as Parameters<typeof withSentences>[0]) as Diagnostic;
}

/** Resolves with what became of a part. If it is refused, its diagnostics have the numbers of the whole surface. */
export async function withWholeNumbers<Made>(numbers: WholeNumbers, made: Promise<Made>): Promise<Made> {
  try {
    return await made;
  } catch (failure) {
    if (!(failure instanceof MesherError) || failure.code !== "invalid-input") throw failure;
    refuse(failure.data.diagnostics.map((found) => inWhole(numbers, found)));
    throw failure;
  }
}

/** Returns a change of a part with the numbers of the whole surface; those of the triangles of filled holes have none there. */
export function changeInWhole(
  { wholeTriangles, wholeNodes }: WholeNumbers,
  change: RepairChange,
): RepairChange {
  const triangleOf = (triangle: number) => wholeTriangles[triangle] ?? NO_ORIGIN;
  const nodeOf = (node: number) => wholeNodes[node] ?? NO_ORIGIN;
  switch (change.kind) {
    case "welded-node":
      return { ...change, node: nodeOf(change.node), into: nodeOf(change.into) };
    case "removed-node":
      return { ...change, node: nodeOf(change.node) };
    case "removed-duplicate":
      return { ...change, triangle: triangleOf(change.triangle), sameAs: triangleOf(change.sameAs) };
    case "split-triangle":
      return { ...change, triangle: triangleOf(change.triangle), beyond: triangleOf(change.beyond) };
    case "filled-hole":
      return change;
    default:
      return { ...change, triangle: triangleOf(change.triangle) };
  }
}

/** Sentences about content of a file that is not used. */
import { plural } from "../base/plural.js";
import type { Mesh } from "../mesh/mesh.js";

/** Returns sentences about ignored content of a file. */
export function readingNotes(
  mesh: Pick<Mesh, "notes" | "duplicateTetrahedra" | "duplicateTriangles" | "unlocatedRegions">,
): string[] {
  return [...duplicateLines(mesh), ...unlocatedLines(mesh), ...(mesh.notes ?? [])];
}

/** Reports elements that keep only their first group. */
function duplicateLines({
  duplicateTetrahedra = 0,
  duplicateTriangles = 0,
}: Pick<Mesh, "duplicateTetrahedra" | "duplicateTriangles">): string[] {
  const lines = (count: number, noun: string) =>
    count === 0 ? [] : [`${plural(count, "repeated entry")} of ${noun} ignored: the first entry counts`];
  return [...lines(duplicateTetrahedra, "tetrahedra"), ...lines(duplicateTriangles, "triangles")];
}

/** Reports names of regions that are lost. */
function unlocatedLines({ unlocatedRegions = [] }: Pick<Mesh, "unlocatedRegions">): string[] {
  if (unlocatedRegions.length === 0) return [];
  const names = unlocatedRegions.map((name) => `"${name}"`).join(", ");
  return [
    `the file does not define where ${names} ${unlocatedRegions.length === 1 ? "is" : "are"}: regions are numbered`,
  ];
}

/** Reports regions of the file that are not meshed. */
export function unmeshedNotes(
  { surfaceRegions }: Pick<Mesh, "surfaceRegions">,
  { regions }: Pick<Mesh, "regions">,
): string[] {
  const leftOut = (surfaceRegions?.regions ?? []).filter(({ tag }) =>
    regions.every((one) => one.tag !== tag),
  );
  if (leftOut.length === 0) return [];
  const names = leftOut.map(({ name }) => `"${name}"`).join(", ");
  const hint =
    surfaceRegions?.areMeshed === true ? "" : '; `innerShells: "regions"` also meshes inside inner shells';
  return [`regions of the file that are not meshed: ${names}${hint}`];
}

import type { Mesher, SizeProposal } from "tetrafront";
import type { Project } from "tetrafront/project";

/**
 * Returns how many tetrahedra the engine expects if a project is meshed with proposed sizes; null if it cannot be meshed. The
 * engine meshes the surface: 0.1 to 2 s for the models of the gallery. Rejects if `signal` aborts.
 */
export async function expectedTetrahedra(
  mesher: Mesher,
  project: Project,
  { size, sources }: SizeProposal,
  signal: AbortSignal,
): Promise<number | null> {
  const input = { ...project, background: { nodes: [], tetrahedra: [], sources } };
  return (await mesher.checkProject(input, { size }, { signal })).expectedTetrahedra;
}

import type { Mesher, SizeProposal } from "tetrafront";
import type { Project } from "tetrafront/project";

/**
 * Returns how many tetrahedra the engine expects if a project is meshed with proposed sizes; null if it cannot be
 * meshed. The engine meshes the surface and is stopped before the front starts: 0.1 to 2 s for the models of the
 * gallery. Rejects if `signal` aborts.
 */
export async function expectedTetrahedra(
  mesher: Mesher,
  project: Project,
  { size, sources }: SizeProposal,
  signal: AbortSignal,
): Promise<number | null> {
  const known = new AbortController();
  let expected = 0;
  const { report } = await mesher.meshProject(
    { ...project, background: { nodes: [], tetrahedra: [], sources } },
    { size },
    {
      signal: AbortSignal.any([signal, known.signal]),
      onProgress: ({ expectedTetrahedra: count }) => {
        if (count === 0) return;
        expected = count;
        known.abort();
      },
    },
  );
  signal.throwIfAborted();
  if (expected > 0) return expected;
  const refusal = report.diagnostics.find((diagnostic) => diagnostic.code === "too-many-elements");
  return refusal?.data.expected ?? null;
}

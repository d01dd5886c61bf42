import {
  MesherError,
  type Mesher,
  type MeshImprovement,
  type MeshInspection,
  type MeshResult,
  type Optimization,
  type PartialControl,
} from "tetrafront";
import { improvedResult, inspectedResult } from "tetrafront/internal";
import type { OpenedMesh } from "../workers/surface-files";

/** What is known of the file that a mesh was opened from. */
export interface MeshOrigin {
  readonly fileName: string;
}

/** What an improvement has gained. */
export type Improvement = Pick<MeshImprovement, "isImproved" | "isPartial" | "before" | "after">;

/** A mesh, where it comes from, and what its last improvement has gained. */
export interface ShownMesh {
  readonly mesh: MeshResult;
  /** Length to which its report compares edges. Only runs know target lengths. */
  readonly edgeReference: "target" | "mean";
  /** Null if a run made the mesh. */
  readonly origin: MeshOrigin | null;
  readonly improvement: Improvement | null;
  /** Whether its inspection has found no defect. Null if a run made the mesh, which verifies what it makes. */
  readonly isValid: boolean | null;
}

/** Returns what is known of a mesh itself, without what else its record has. */
export const shownParts = ({ mesh, edgeReference, origin, improvement, isValid }: ShownMesh): ShownMesh => ({
  mesh,
  edgeReference,
  origin,
  improvement,
  isValid,
});

/** Returns a mesh that was read from a file. Rejects if its arrays are invalid. */
export async function openedMesh(mesher: Mesher, fileName: string, opened: OpenedMesh): Promise<ShownMesh> {
  const inspection = await mesher.inspectMesh(opened.mesh);
  return {
    mesh: inspectedResult(opened, inspection),
    edgeReference: "mean",
    origin: { fileName },
    improvement: null,
    isValid: inspection.isValid,
  };
}

/** Returns a mesh with better elements, or the same mesh if none was found; with what was gained. */
export async function improvedMesh(
  mesher: Mesher,
  shown: ShownMesh,
  optimization: Optimization,
  control: PartialControl,
): Promise<ShownMesh> {
  const { mesh, origin } = shown;
  const options = { optimization: optimization === "none" ? "default" : optimization };
  const found = await mesher.improveMesh(mesh.mesh, options, { ...control, partial: true });
  const { isImproved, isPartial, before, after } = found;
  const improvement = { isImproved, isPartial, before, after };
  if (!isImproved) return { ...shown, improvement };
  const inspection: MeshInspection = await mesher.inspectMesh(found.mesh);
  return {
    mesh: improvedResult(mesh, found, inspection),
    edgeReference: "mean",
    origin,
    improvement,
    isValid: inspection.isValid,
  };
}

/** Returns why a mesh could not be opened or improved, one sentence each. */
export function reasonsOf(error: unknown): readonly string[] {
  if (!(error instanceof MesherError) || error.code !== "invalid-input") return [String(error)];
  return error.data.diagnostics.map(({ message, remedy }) =>
    [message, remedy].filter((text) => text !== "").join(". "),
  );
}

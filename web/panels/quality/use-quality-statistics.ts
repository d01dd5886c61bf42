import { useEffect, useState } from "react";
import type { MeshInspection, MeshResult, QualityReport } from "tetrafront";
import { showFailure } from "../../commands/messages";
import type { QualitySpace } from "../../document/mesh-quality";
import { strings } from "../../strings";
import { useApp, useRun } from "../shared/app-context";

/** All statistics of the quality panel, measured in one space. */
export interface QualityStatistics {
  readonly quality: QualityReport;
  /** Length to which edges are compared. */
  readonly edgeReference: "target" | "mean";
}

/** Returns the statistics of a mesh in a space; null while the engine computes them. */
export function useQualityStatistics(mesh: MeshResult, space: QualitySpace | null): QualityStatistics | null {
  const inspection = useInspection(space === "space" ? mesh : null);
  const edgeReference = useRun((state) => state.edgeReference);
  if (space !== "space") return { quality: mesh.report.quality, edgeReference };
  return inspection && { quality: inspection.quality, edgeReference: "mean" };
}

/** Inspects a mesh, which measures it in space. */
function useInspection(mesh: MeshResult | null): MeshInspection | null {
  const app = useApp();
  const [known, setKnown] = useState<{ mesh: MeshResult; inspection: MeshInspection } | null>(null);
  useEffect(() => {
    if (!mesh) return undefined;
    const abort = new AbortController();
    const { signal } = abort;
    app.mesher
      .then((mesher) => mesher.inspectMesh(mesh.mesh, { signal }))
      .then((inspection) => setKnown({ mesh, inspection }))
      .catch((error: unknown) => {
        if (!signal.aborted) showFailure(app, strings.report.title, error);
      });
    return () => abort.abort();
  }, [app, mesh]);
  return known !== null && known.mesh === mesh ? known.inspection : null;
}

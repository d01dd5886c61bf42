import { useEffect, useMemo, useState } from "react";
import type { MeshInspection, MeshResult, QualityReport } from "tetrafront";
import { showFailure } from "../../commands/messages";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";

/**
 * Where shapes and lengths are measured. In the metric of a stretched background grid, the target element is regular
 * with edges of length 1. In space, elements are measured as they are drawn.
 */
export type QualitySpace = "metric" | "space";

/** All statistics of the quality panel, measured in one space. */
export interface QualityStatistics {
  readonly quality: QualityReport;
  /** Exact extremes; null in the metric of a stretched grid, for which the report has histograms only. */
  readonly extremes: Pick<MeshInspection, "dihedral" | "radiusRatio"> | null;
  /** Length to which edges are compared. */
  readonly edgeReference: "target" | "mean";
}

/** Does the background grid ask for stretched elements? */
export function useIsStretched(): boolean {
  const { background, meshing } = useProject();
  return useMemo(
    () => meshing?.size === undefined && background.nodes.some(({ stretching = 1 }) => stretching > 1),
    [background.nodes, meshing?.size],
  );
}

/** Returns the statistics of a mesh in a space; null while the engine computes them. */
export function useQualityStatistics(
  mesh: MeshResult,
  isStretched: boolean,
  space: QualitySpace,
): QualityStatistics | null {
  const isInSpace = isStretched && space === "space";
  const inspection = useInspection(isInSpace ? mesh : null);
  const { report } = mesh;
  if (!isInSpace) {
    return { quality: report.quality, extremes: isStretched ? null : report, edgeReference: "target" };
  }
  return inspection && { quality: inspection.quality, extremes: inspection, edgeReference: "mean" };
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
      .then((mesher) => mesher.inspectMesh(mesh.volume, { signal }))
      .then((inspection) => setKnown({ mesh, inspection }))
      .catch((error: unknown) => {
        if (!signal.aborted) showFailure(app, strings.report.title, error);
      });
    return () => abort.abort();
  }, [app, mesh]);
  return known !== null && known.mesh === mesh ? known.inspection : null;
}

import { useEffect, useState } from "react";
import type { MeshResult } from "tetrafront";
import type { Histogram, QualityMeasure } from "../../document/mesh-quality";
import { useApp } from "../shared/app-context";

interface Known {
  readonly mesh: MeshResult;
  readonly measure: QualityMeasure;
  readonly histogram: Histogram;
}

/** Returns the histogram of a measure over the elements of a mesh; null without a mesh and until it is computed. */
export function useHistogram(
  mesh: MeshResult | null,
  measure: QualityMeasure,
  barCount: number,
): Histogram | null {
  const { meshQueries } = useApp();
  const [known, setKnown] = useState<Known | null>(null);
  useEffect(() => {
    if (!mesh) return undefined;
    let isCurrent = true;
    meshQueries.histogram(mesh.volume, measure, barCount).then(
      (histogram) => isCurrent && setKnown({ mesh, measure, histogram }),
      // The view shows the failure; the statistics of the report remain.
      () => undefined,
    );
    return () => void (isCurrent = false);
  }, [meshQueries, mesh, measure, barCount]);
  return known && known.mesh === mesh && known.measure === measure ? known.histogram : null;
}

import { useEffect, useState } from "react";
import type { MeshResult } from "tetrafront";
import type { Histogram, QualityMeasure, QualitySpace } from "../../document/mesh-quality";
import { useApp } from "../shared/app-context";

interface Known {
  readonly mesh: MeshResult;
  readonly measure: QualityMeasure;
  readonly space: QualitySpace;
  readonly histogram: Histogram;
}

/** Returns the histogram of a measure over the elements of a mesh; null without a mesh and until it is computed. */
export function useHistogram(
  mesh: MeshResult | null,
  measure: QualityMeasure,
  space: QualitySpace,
  barCount: number,
): Histogram | null {
  const { meshQueries } = useApp();
  const [known, setKnown] = useState<Known | null>(null);
  useEffect(() => {
    if (!mesh) return undefined;
    let isCurrent = true;
    meshQueries.histogram(mesh, measure, space, barCount).then(
      (histogram) => isCurrent && setKnown({ mesh, measure, space, histogram }),
      // The view shows the failure; the statistics of the report remain.
      () => undefined,
    );
    return () => void (isCurrent = false);
  }, [meshQueries, mesh, measure, space, barCount]);
  const isKnown = known?.mesh === mesh && known.measure === measure && known.space === space;
  return isKnown ? known.histogram : null;
}

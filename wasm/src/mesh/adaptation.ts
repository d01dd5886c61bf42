/** Result of the adaptation of a mesh to a metric. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { Mesh } from "./mesh.js";

/** Lengths of edges and qualities of elements in a metric. */
export interface MetricStatistics {
  readonly nodes: number;
  readonly tetrahedra: number;
  readonly edges: number;
  /** Share of the edges with a length from 1 / √2 to √2. */
  readonly unitEdges: number;
  /** Share of the edges with a length from 0.8 to 1.25. */
  readonly peakedEdges: number;
  readonly shortest: number;
  readonly longest: number;
  /** Mean ratio in the metric of the node with the smallest sizes: 1 for a regular element. */
  readonly leastQuality: number;
  readonly meanQuality: number;
  /** Number of edges per class of 16: class i has lengths from 2^(i/4 − 2) to 2^(i/4 − 7/4); the outer two have all beyond. */
  readonly lengths: readonly number[];
}

/** Result of `adaptMesh`. */
export interface MeshAdaptation {
  /** The adapted mesh, with the names of patches and regions, and with the metric as node values `metric`. */
  readonly mesh: Mesh;
  /** Whether the call was stopped early. */
  readonly isPartial: boolean;
  readonly before: MetricStatistics;
  readonly after: MetricStatistics;
  readonly diagnostics: readonly Diagnostic[];
}

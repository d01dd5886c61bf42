import type { SweptMesh } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { qualityOf } from "../../document/mesh-quality";
import { cornersPerElement, writeElement } from "./element-buffers";
import { poorAngle } from "./poor-angle";

/** Number of elements drawn at most, the worst first. */
const drawnCount = 2000;

export interface PoorElement {
  /** Index in the mesh. */
  readonly element: number;
  /** Smallest dihedral angle, in degrees. */
  readonly angle: number;
}

/** Returns the elements with a dihedral angle below `poorAngle` as seen in space, the worst first. O(elements). */
export function poorElements(mesh: SweptMesh): readonly PoorElement[] {
  return Array.from(mesh.tetrahedronRegion, (_, element) => ({
    element,
    angle: qualityOf(mesh, "dihedral", element),
  }))
    .filter(({ angle }) => angle < poorAngle)
    .sort((a, b) => a.angle - b.angle);
}

/** The poor elements of a mesh, as triangles for the graphics card. */
export class SweepBuffers {
  /** x y z per corner, relative to the origin. */
  readonly positions: Float32Array;
  /** Smallest angle of the element per corner. */
  readonly values: Float32Array;

  constructor(mesh: SweptMesh, origin: Position) {
    const drawn = poorElements(mesh).slice(0, drawnCount);
    this.positions = new Float32Array(3 * cornersPerElement * drawn.length);
    this.values = new Float32Array(cornersPerElement * drawn.length);
    drawn.forEach(({ element, angle }, slot) => {
      const nodes = mesh.tetrahedra.subarray(4 * element, 4 * element + 4);
      writeElement(this.positions, slot, mesh.points, nodes, origin);
      this.values.fill(angle, cornersPerElement * slot, cornersPerElement * (slot + 1));
    });
  }
}

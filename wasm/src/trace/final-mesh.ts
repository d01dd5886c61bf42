/** The mesh at the end of a trace, in the order of BasicVolumeMesher::mesh() and RegionMesher. */
import { Fingerprint } from "./fingerprint.js";
import { NEVER, NONE } from "./layout.js";
import type { TraceElements } from "./trace-columns.js";

/** What each pass ends with: its nodes, without those of the boundary, and its elements, removed ones included. */
export interface FinalLists {
  readonly boundaryNodes: number;
  readonly passes: readonly { readonly nodes: Uint32Array; readonly elements: Uint32Array }[];
}

/** The mesh when the front has ended, before the optimization. */
export interface TracedMesh {
  /** x y z per node: those of the boundary, and those used by an element. */
  readonly points: Float64Array;
  /** Four nodes per tetrahedron. */
  readonly tetrahedra: Uint32Array;
  /** Region per tetrahedron. */
  readonly tetrahedronRegion: Uint32Array;
  /** 16 hexadecimal digits: hash of points and tetrahedra. */
  readonly fingerprint: string;
}

export function finalMesh(
  positions: Float64Array,
  elements: TraceElements,
  { boundaryNodes, passes }: FinalLists,
): TracedMesh {
  const live = passes.map((pass) => pass.elements.filter((element) => elements.died[element] === NEVER));
  const count = live.reduce((sum, list) => sum + list.length, 0);
  const isUsed = new Uint8Array(positions.length / 3).fill(1, 0, boundaryNodes);
  for (const list of live)
    for (const element of list)
      for (let corner = 0; corner < 4; corner++) isUsed[elements.nodes[4 * element + corner] ?? 0] = 1;

  const indexOf = new Uint32Array(isUsed.length).fill(NONE);
  const points = new Float64Array(positions.length);
  let nodeCount = 0;
  const add = (node: number): void => {
    if (isUsed[node] !== 1) return;
    points.set(positions.subarray(3 * node, 3 * node + 3), 3 * nodeCount);
    indexOf[node] = nodeCount++;
  };
  for (let node = 0; node < boundaryNodes; node++) add(node);
  for (const { nodes } of passes) nodes.forEach(add);

  const tetrahedra = new Uint32Array(4 * count);
  const tetrahedronRegion = new Uint32Array(count);
  let at = 0;
  for (const list of live) {
    for (const element of list) {
      for (let corner = 0; corner < 4; corner++)
        tetrahedra[4 * at + corner] = indexOf[elements.nodes[4 * element + corner] ?? 0] ?? 0;
      tetrahedronRegion[at++] = elements.regions[element] ?? 0;
    }
  }
  const fingerprint = new Fingerprint();
  const coordinates = points.slice(0, 3 * nodeCount);
  fingerprint.addDoubles(coordinates);
  fingerprint.addIntegers(tetrahedra);
  return { points: coordinates, tetrahedra, tetrahedronRegion, fingerprint: fingerprint.text() };
}

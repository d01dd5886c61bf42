/** The outline of a recorded model: its lines, or the sharp edges of a given boundary. */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { cross, dot, subtract, unit } from "../../document/vectors";
import { cornersOf, nodesOf, positionOf } from "./judge";
import { surfaceScene } from "./surface-scene";

/** An edge is sharp if the normals of its faces differ by more than this, in degrees. */
const sharpAngle = 30;
const sharpCosine = Math.cos((sharpAngle * Math.PI) / 180);

const known = new WeakMap<Trace, readonly Position[]>();

/** Returns the ends of segments, two after two. O(sides, or faces of the boundary) for the first call. */
export function modelOutline(trace: Trace): readonly Position[] {
  const before = known.get(trace);
  if (before) return before;
  const outline = trace.surface ? surfaceScene(trace, trace.surface.stepCount).sides : sharpEdges(trace);
  known.set(trace, outline);
  return outline;
}

/** The edges of the first front whose faces meet at an angle, or of which there are not two. */
function sharpEdges(trace: Trace): readonly Position[] {
  const normals = new Map<string, { readonly ends: readonly [number, number]; readonly of: Position[] }>();
  for (const face of trace.frontAt(0)) {
    const [a, b, c] = cornersOf(trace, face);
    const normal = unit(cross(subtract(b, a), subtract(c, a))) ?? [0, 0, 0];
    const nodes = nodesOf(trace, face);
    nodes.forEach((node, i) => {
      const other = nodes[(i + 1) % 3] ?? node;
      const ends = [Math.min(node, other), Math.max(node, other)] as const;
      const key = ends.join(" ");
      const edge = normals.get(key);
      if (edge) edge.of.push(normal);
      else normals.set(key, { ends, of: [normal] });
    });
  }
  return [...normals.values()].flatMap(({ ends, of: [first, second, third] }) => {
    const isSmooth = first && second && !third && dot(first, second) > sharpCosine;
    return isSmooth ? [] : ends.map((node) => positionOf(trace, node));
  });
}

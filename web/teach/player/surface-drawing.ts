/** The lines and patches of a trace as a drawing of lines and areas (SVG), for slides and papers. */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { cross, subtract } from "../../document/vectors";
import { viewerColors } from "../../ui/theme/theme";
import type { Triangle } from "./crossing";
import {
  depthOf,
  drawnLabels,
  edgeColor,
  lightOf,
  pathOf,
  pointsOf,
  shaded,
  svgOf,
  type DrawingView,
} from "./front-drawing";
import type { LensLabel } from "./lens-marks";
import { phaseAt, surfaceState } from "./phases";
import { escaped } from "./svg";
import { finishedPatches, stepMarks, surfaceScene, type PatchTriangles } from "./surface-scene";

const colors = viewerColors.light;
/** Sides are drawn above triangles at the same distance: this share nearer. */
const nearer = 0.99;

interface Drawn {
  readonly depth: number;
  readonly svg: string;
}

export interface DrawnSurfaceState {
  /** Negative, as in the player. */
  readonly step: number;
  /** As for `examinedCandidate`. */
  readonly candidate: number | null;
  readonly labels: readonly LensLabel[];
}

/** Returns the drawing, with what is far from the eye first, and the front and the marks of the step above all. O(n log n). */
export function surfaceDrawing(trace: Trace, state: DrawnSurfaceState, view: DrawingView): string {
  const { step, candidate, labels } = state;
  const shown = surfaceState(trace, step) ?? 0;
  const scene = surfaceScene(trace, shown, candidate);
  const marks = stepMarks(trace, shown, candidate);
  const made = trace.surface?.fronts[scene.finished];
  const drawn = [
    ...finishedPatches(trace)
      .slice(0, scene.finished)
      .flatMap((patch) => triangles(patch, patch.triangles.length / 3, colors.patch, view)),
    ...(made ? triangles(made, scene.made, colors.meshPlain, view) : []),
    ...sides(scene.sides, view),
  ].sort((a, b) => b.depth - a.depth);
  const { phase, from, to } = phaseAt(trace, step);
  const above = [
    path(scene.front, colors.front, 2.4, view),
    path(scene.walk, colors.selection, 2.4, view),
    path(marks.base, colors.selection, 4, view),
    path(marks.culprit, colors.failing, 4, view),
  ];
  return svgOf(`${escaped(trace.header.name)}, ${phase}, step ${step - from} of ${to - from}`, view, [
    `<g stroke-linejoin="round" stroke-linecap="round">`,
    ...drawn.map(({ svg }) => svg),
    area(marks.triangle, colors.selection, 0.5, view),
    area(marks.supposed, colors.failing, 0.35, view),
    ...above,
    "</g>",
    ...drawnLabels({ labels }, view),
  ]);
}

/** The first triangles of a patch. Both sides are seen. */
function triangles(patch: PatchTriangles, count: number, color: string, view: DrawingView): readonly Drawn[] {
  const at = (node = 0): Position => [
    patch.positions[3 * node] ?? 0,
    patch.positions[3 * node + 1] ?? 0,
    patch.positions[3 * node + 2] ?? 0,
  ];
  const drawn: Drawn[] = [];
  for (let i = 0; i < count; i++) {
    const [a, b, c] = patch.triangles.subarray(3 * i, 3 * i + 3);
    const corners: Triangle = [at(a), at(b), at(c)];
    const points = pointsOf(corners, view);
    if (points === null) continue;
    const normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
    const fill = shaded(color, lightOf(normal, subtract(view.eye, corners[0])));
    drawn.push({
      depth: depthOf(corners, view.eye),
      svg: `<polygon points="${points}" fill="${fill}" stroke="${edgeColor}" stroke-width="0.6"/>`,
    });
  }
  return drawn;
}

function sides(ends: readonly Position[], view: DrawingView): readonly Drawn[] {
  const drawn: Drawn[] = [];
  for (let i = 0; i + 2 <= ends.length; i += 2) {
    const pair = ends.slice(i, i + 2);
    drawn.push({ depth: nearer * depthOf(pair, view.eye), svg: path(pair, colors.line, 1.6, view) });
  }
  return drawn;
}

/** Returns a triangle as an area; an empty text if there is none in view. */
function area([a, b, c]: readonly Position[], color: string, opacity: number, view: DrawingView): string {
  const points = a && b && c ? pointsOf([a, b, c], view) : null;
  return points === null ? "" : `<polygon points="${points}" fill="${color}" fill-opacity="${opacity}"/>`;
}

/** Returns segments as a path; an empty text if none is in view. */
function path(ends: readonly Position[], color: string, width: number, view: DrawingView): string {
  const d = pathOf(ends, 2, view);
  return d === "" ? "" : `<path d="${d}" fill="none" stroke="${color}" stroke-width="${width}"/>`;
}

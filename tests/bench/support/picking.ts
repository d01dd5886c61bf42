/** What the picking benchmark measures: the hit test of the view, without a browser. */
import type { Project } from "tetrafront/project";
import { FrontSide } from "three";
import { emptyProject } from "../../../web/document/create";
import { hitTest } from "../../../web/viewer/hit-test";
import { DotsLayer } from "../../../web/viewer/layers/dots-layer";
import type { Hit, HittableLayer } from "../../../web/viewer/layers/layer";
import { LinesLayer } from "../../../web/viewer/layers/lines-layer";
import { PatchesLayer } from "../../../web/viewer/layers/patches-layer";
import { faceNodes, findNeighbours, outside } from "../../../web/viewer/queries/topology";
import type { Screen } from "../../../web/viewer/screen";
import { buildTree } from "../../../web/viewer/triangle-boxes";
import { TriangleTree } from "../../../web/viewer/triangle-tree";
import { gridMesh } from "../../unit/web/grid-mesh";
import { frontCamera, preview, sceneState, show, viewport } from "../../unit/web/scene";
import { randomSource } from "../../support/random";

/** Milliseconds per hit test. */
export interface Measurement {
  readonly what: string;
  readonly median: number;
  /** 19 of 20 hit tests take no longer. */
  readonly most: number;
}

/** Cells along each axis: six tetrahedra each make 998 250. */
const cells = 55;
/** Points, lines and patches of the model: 2000 in all. */
const counts = { points: 700, lines: 700, patches: 600 };
const pointers = 400;
const warmUp = 50;
const repetitions = 5;

export async function measurePicking(): Promise<readonly Measurement[]> {
  const layers = modelLayers();
  const mesh = await meshLayer();
  const nothing: HittableLayer = { ...({} as HittableLayer), hit: () => null };
  return [
    measured("2000 entities", layers, nothing),
    measured("2000 entities, boundary of 998 250 tetrahedra", layers, mesh),
  ];
}

type ModelLayers = Readonly<Record<"points" | "lines" | "patches", HittableLayer>>;

function measured(what: string, { points, lines, patches }: ModelLayers, solid: HittableLayer): Measurement {
  const random = unitRandom(1);
  const camera = frontCamera();
  const order = { solid: [solid], onSurfaces: [points, lines], translucent: patches };
  const pick = (): number => {
    const pointer = { x: viewport.width * random(), y: viewport.height * random() };
    // The shortest of several: other programs may interrupt one.
    const times = Array.from({ length: repetitions }, () => {
      const begin = performance.now();
      hitTest(order, camera, viewport, pointer);
      return performance.now() - begin;
    });
    return Math.min(...times);
  };
  // The first ones build trees and are compiled.
  for (let i = 0; i < warmUp; ++i) pick();
  const times = Array.from({ length: pointers }, pick).toSorted((a, b) => a - b);
  return { what, median: times[pointers / 2] ?? 0, most: times[Math.floor(0.95 * pointers)] ?? 0 };
}

/** Returns a generator of numbers from 0 to 1. */
function unitRandom(seed: number): () => number {
  const random = randomSource(seed);
  return () => random() / 2 ** 32;
}

/** Points, lines and patches at random places before the camera. */
function modelLayers(): ModelLayers {
  const random = unitRandom(2);
  const place = (): [number, number, number] => [8 * random() - 4, 4 * random(), 6 * random() - 3];
  const polyline = Array.from({ length: counts.lines }, () => Array.from({ length: 16 }, place).flat());
  const triangles = Array.from({ length: counts.patches }, () => Array.from({ length: 48 }, place).flat());
  const project: Project = {
    ...emptyProject("bench"),
    points: Array.from({ length: counts.points }, (_, i) => ({ id: i + 1, position: place() })),
    lines: polyline.map((_, i) => ({ id: i + 1, type: "spline" as const, points: [1, 2, 3, 4] })),
    patches: triangles.map((_, i) => ({ id: i + 1, type: "planar" as const, loops: [] })),
  };
  const state = sceneState({ project, preview: { samples: preview(polyline, triangles), project } });
  const points = new DotsLayer({
    kind: "point",
    name: "points",
    shape: "round",
    color: (colors) => colors.point,
    records: (shown) => shown.project.points,
    positions: ({ position }) => [position],
  });
  const layers = {
    points,
    lines: new LinesLayer(),
    patches: new PatchesLayer((corners) => Promise.resolve(buildTree(corners))),
  };
  for (const layer of Object.values(layers)) show(layer, state);
  return layers;
}

/** The boundary of a million tetrahedra, in a tree as the view has it. */
async function meshLayer(): Promise<HittableLayer> {
  const volume = gridMesh(cells);
  const faces: number[] = [];
  findNeighbours(volume.tetrahedra).forEach((beyond, face) => {
    if (beyond !== outside) return;
    for (let k = 0; k < 3; ++k) {
      faces.push(volume.tetrahedra[(face & ~3) + (faceNodes[3 * (face & 3) + k] ?? 0)] ?? 0);
    }
  });
  const corners = new Float32Array(3 * faces.length);
  faces.forEach((node, corner) => {
    for (let k = 0; k < 3; ++k)
      corners[3 * corner + k] = ((volume.points[3 * node + k] ?? 0) / cells - 0.5) * 4;
  });
  const tree = new TriangleTree(corners);
  await tree.prepare((given) => Promise.resolve(buildTree(given)));
  return {
    ...({} as HittableLayer),
    hit: (ray, _screen: Screen): Hit | null => {
      const hit = tree.firstHit(ray, FrontSide);
      return (
        hit && { target: { kind: "element", index: hit.triangle }, position: hit.point, depth: hit.distance }
      );
    },
  };
}

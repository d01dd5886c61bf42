import type { Trace } from "tetrafront/trace";
import { BufferAttribute, BufferGeometry, Group, Mesh, Sphere } from "three";
import type { Position } from "../../document/position";
import type { Layer } from "../../viewer/layers/layer";
import { createFacetMaterial } from "../../viewer/materials/facet-material";
import { setColor } from "../../viewer/materials/uniforms";
import type { SceneChanges } from "../../viewer/scene-state";
import type { Beat } from "../strings/film";
import { Dots, Facets, WideSegments } from "./lens-parts";
import { finishedPatches, stepMarks, surfaceScene, type PatchTriangles } from "./surface-scene";

/** The beat of a step, and whether it shows what the step found, not what it has made. */
export interface SurfaceFilm {
  readonly beat: Beat | null;
  readonly isUnfinished: boolean;
}

const noFilm: SurfaceFilm = { beat: null, isUnfinished: false };

/** The lines and patches of a trace after a step, in space, with the base edge, its new triangle, and what refuses a candidate. */
export class SurfaceLayer implements Layer {
  readonly root = new Group();
  readonly #trace: Trace;
  readonly #done = new TriangleRange();
  readonly #made = new TriangleRange();
  readonly #sides = new WideSegments("line", 1.6, true);
  readonly #front = new WideSegments("front", 2.4, false);
  readonly #walk = new WideSegments("selection", 2.4, false);
  readonly #base = new WideSegments("selection", 4, false);
  readonly #culprit = new WideSegments("failing", 4, false);
  readonly #nodes = new Dots("point", 6);
  readonly #triangle = new Facets("selection", 0.5);
  readonly #supposed = new Facets("failing", 0.35);
  readonly #wide = [this.#sides, this.#front, this.#walk, this.#base, this.#culprit];
  /** Triangles before those of each front, of the finished patches and of the fronts. */
  #doneBefore: readonly number[] = [0];
  #madeBefore: readonly number[] = [0];
  #state: number | null = null;
  #candidate: number | null = null;
  #film: SurfaceFilm = noFilm;
  /** Whether the triangles are there, relative to the present origin. They are made when a state is first shown. */
  #hasTriangles = false;
  #origin: Position = [0, 0, 0];

  constructor(trace: Trace) {
    this.#trace = trace;
    const { object: nodes } = this.#nodes;
    const { object: triangle } = this.#triangle;
    const { object: supposed } = this.#supposed;
    for (const object of [nodes, triangle, supposed]) object.frustumCulled = false;
    const drawn = [
      this.#done.object,
      this.#made.object,
      ...this.#wide.map(({ object }) => object),
      nodes,
      triangle,
      supposed,
    ];
    drawn.forEach((object, order) => {
      object.renderOrder = 10 + order;
      this.root.add(object);
    });
    this.root.visible = false;
  }

  update(changes: SceneChanges): void {
    const { colors, origin, viewport } = changes.state;
    if (changes.has("colors")) {
      for (const part of [...this.#wide, this.#nodes, this.#triangle, this.#supposed]) part.setColors(colors);
      this.#done.setColors(colors.patch, colors.meshEdge);
      this.#made.setColors(colors.meshPlain, colors.meshEdge);
    }
    if (changes.has("viewport")) for (const part of [...this.#wide, this.#nodes]) part.setViewport(viewport);
    if (!changes.has("origin")) return;
    this.#origin = origin;
    this.#hasTriangles = false;
    this.show(this.#state, this.#candidate, this.#film);
  }

  /**
   * Shows a state of the lines and patches, from 0; null to show nothing. `candidate`: as for `examinedCandidate`.
   */
  show(state: number | null, candidate: number | null = null, film = noFilm): void {
    this.#film = film;
    this.#state = state;
    this.#candidate = candidate;
    this.root.visible = state !== null;
    if (state === null) return;
    if (!this.#hasTriangles) this.#writeTriangles();
    const shown = film.isUnfinished ? state - 1 : state;
    const scene = surfaceScene(this.#trace, shown, film.isUnfinished ? null : this.#candidate);
    this.#sides.set(scene.sides, this.#origin);
    this.#walk.set(scene.walk, this.#origin);
    this.#front.set(scene.front, this.#origin);
    this.#nodes.set(scene.nodes, this.#origin);
    this.#done.show(0, this.#doneBefore[scene.finished] ?? 0);
    this.#made.show(this.#madeBefore[scene.finished] ?? 0, scene.made);
    this.#showStep(state);
  }

  dispose(): void {
    const parts = [this.#nodes, this.#triangle, this.#supposed, this.#done, this.#made];
    for (const part of [...this.#wide, ...parts]) part.dispose();
  }

  /** Draws the base edge of a step, the triangle over it, and the edge because of which its candidate was refused. */
  #showStep(state: number): void {
    const { base, culprit, triangle, supposed } = stepMarks(
      this.#trace,
      state,
      this.#candidate,
      this.#film.beat,
    );
    this.#base.set(base, this.#origin);
    this.#culprit.set(culprit, this.#origin);
    this.#triangle.set(triangle, this.#origin);
    this.#supposed.set(supposed, this.#origin);
  }

  #writeTriangles(): void {
    const fronts = this.#trace.surface?.fronts ?? [];
    const finished = finishedPatches(this.#trace);
    this.#doneBefore = countsBefore(finished);
    this.#madeBefore = countsBefore(fronts);
    this.#done.set(cornersOf(finished, this.#origin));
    this.#made.set(cornersOf(fronts, this.#origin));
    this.#hasTriangles = true;
  }
}

/** Returns the number of triangles before each part, and of all parts at the end. */
function countsBefore(parts: readonly PatchTriangles[]): number[] {
  const counts = [0];
  let count = 0;
  for (const { triangles } of parts) counts.push((count += triangles.length / 3));
  return counts;
}

/** Returns x y z of the corners of all triangles, relative to an origin. */
function cornersOf(parts: readonly PatchTriangles[], origin: Position): Float32Array {
  const corners = new Float32Array(9 * (countsBefore(parts).at(-1) ?? 0));
  let next = 0;
  for (const { positions, triangles } of parts)
    for (const node of triangles)
      for (let axis = 0; axis < 3; axis++)
        corners[next++] = (positions[3 * node + axis] ?? 0) - (origin[axis] ?? 0);
  return corners;
}

/** Triangles of which a range is drawn. */
class TriangleRange {
  readonly object: Mesh;
  readonly #material = createFacetMaterial({ opacity: 1, depthWrite: true, edges: true, polygonOffset: 1 });

  constructor() {
    this.object = new Mesh(new BufferGeometry(), this.#material);
    this.object.frustumCulled = false;
  }

  setColors(color: string, edgeColor: string): void {
    setColor(this.#material, "color", color);
    setColor(this.#material, "edgeColor", edgeColor);
  }

  set(coordinates: Float32Array): void {
    this.object.geometry.dispose();
    const attribute = new BufferAttribute(coordinates, 3);
    this.object.geometry = new BufferGeometry().setAttribute("position", attribute);
    // For the order of drawing; three.js would look at all corners.
    this.object.geometry.boundingSphere = new Sphere();
  }

  show(first: number, count: number): void {
    this.object.geometry.setDrawRange(3 * first, 3 * count);
    this.object.visible = count > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.#material.dispose();
  }
}

import type { Project, ProjectPreview } from "tetrafront";
import { DoubleSide, FrontSide, Raycaster, Vector2, Vector3, type Camera } from "three";
import { entityKey, type Entity } from "../document/entities";
import type { ViewState } from "../document/selection";
import type { Position } from "./layers/layer";
import type { MeshLayer } from "./layers/mesh-layer";
import type { PatchesLayer } from "./layers/patches-layer";
import { nearestHit, type RayHit } from "./ray-hit";

/** What lies under the pointer: something drawn, or a tetrahedron on a cut. */
export interface Pick {
  readonly entity: Entity | null;
  readonly element: number | null;
}

export interface PickScene {
  readonly project: Project;
  readonly preview: ProjectPreview | null;
  /** The project that `preview` shows. */
  readonly previewProject: Project | null;
  readonly view: ViewState;
  readonly origin: Position;
  readonly patchOfFace: (nodes: readonly number[]) => number | null;
}

/** How near the pointer must be, in pixels. */
const dotReach = 9;
const lineReach = 6;
/** What lies this little behind a surface, relative to the distance, still counts as on it. */
const depthSlack = 0.004;

const nothing: Pick = { entity: null, element: null };

/** Finds what is drawn at a place of the screen: dots before lines before surfaces. */
export class Picker {
  readonly #camera: Camera;
  readonly #meshLayer: MeshLayer;
  readonly #patchesLayer: PatchesLayer;
  readonly #raycaster = new Raycaster();
  readonly #scratch = new Vector3();

  constructor(camera: Camera, meshLayer: MeshLayer, patchesLayer: PatchesLayer) {
    this.#camera = camera;
    this.#meshLayer = meshLayer;
    this.#patchesLayer = patchesLayer;
  }

  /** `at` and `size` in CSS pixels of the canvas. */
  pick(at: Vector2, size: Vector2, scene: PickScene): Pick {
    const pointer = new Vector2((2 * at.x) / size.x - 1, 1 - (2 * at.y) / size.y);
    this.#raycaster.setFromCamera(pointer, this.#camera);
    const surface = this.#surfaceHit(scene.view);
    const limit = surface ? surface.distance * (1 + depthSlack) : Infinity;
    const dot =
      this.#nearestDot(at, size, scene, limit) ??
      this.#nearestSource(at, size, scene) ??
      this.#nearestLine(at, size, scene, limit);
    if (dot) return { entity: dot, element: null };
    return surface ? this.#surfacePick(surface.triangle, scene) : this.#patchPick(scene);
  }

  /** Position on the screen in CSS pixels, and the distance from the eye; null behind the camera. */
  toScreen(
    place: Position,
    size: Vector2,
    origin: Position,
  ): { x: number; y: number; distance: number } | null {
    this.#scratch.set(place[0] - origin[0], place[1] - origin[1], place[2] - origin[2]);
    const distance = this.#scratch.distanceTo(this.#camera.position);
    this.#scratch.project(this.#camera);
    if (this.#scratch.z > 1 || this.#scratch.z < -1) return null;
    return { x: ((this.#scratch.x + 1) / 2) * size.x, y: ((1 - this.#scratch.y) / 2) * size.y, distance };
  }

  #surfaceHit(view: ViewState): RayHit | null {
    const geometry = view.layers.mesh ? this.#meshLayer.geometry : null;
    return geometry && nearestHit(this.#raycaster.ray, geometry, FrontSide);
  }

  #surfacePick(triangle: number, scene: PickScene): Pick {
    const face = this.#meshLayer.faceAt(triangle);
    if (!face) return nothing;
    const position = face.onBoundary ? scene.patchOfFace(face.nodes) : null;
    const patch = position === null ? undefined : scene.project.patches[position];
    if (patch) return { entity: { kind: "patch", id: patch.id }, element: null };
    return { entity: null, element: face.tetrahedron };
  }

  #patchPick({ previewProject, view }: PickScene): Pick {
    const geometry = view.layers.patches ? this.#patchesLayer.geometry : null;
    const hit = geometry && nearestHit(this.#raycaster.ray, geometry, DoubleSide);
    const position = hit && this.#patchesLayer.patchOf(hit.triangle);
    const patch = position === null ? undefined : previewProject?.patches[position];
    return patch ? { entity: { kind: "patch", id: patch.id }, element: null } : nothing;
  }

  #nearestDot(at: Vector2, size: Vector2, scene: PickScene, limit: number): Entity | null {
    const { project, view, origin } = scene;
    const kinds = [
      ["point", view.layers.points ? project.points : []],
      ["background-node", view.layers.background ? project.background.nodes : []],
    ] as const;
    let best: Entity | null = null;
    let bestDistance = dotReach;
    for (const [kind, records] of kinds) {
      for (const { id, at: place } of records) {
        const screen = this.toScreen(place, size, origin);
        if (!screen || screen.distance > limit) continue;
        const distance = Math.hypot(screen.x - at.x, screen.y - at.y);
        if (distance >= bestDistance || view.hidden.has(entityKey({ kind, id }))) continue;
        best = { kind, id };
        bestDistance = distance;
      }
    }
    return best;
  }

  /** Sources are drawn through everything, and found through everything. */
  #nearestSource(at: Vector2, size: Vector2, { project, view, origin }: PickScene): Entity | null {
    if (!view.layers.sources) return null;
    let best: Entity | null = null;
    let bestDistance = lineReach;
    for (const { id, places } of project.background.sources ?? []) {
      places.forEach((place, i) => {
        const a = this.toScreen(place, size, origin);
        const b = this.toScreen(places[(i + 1) % places.length] ?? place, size, origin);
        const distance = a && b ? distanceToSegment(at.x, at.y, a, b) : Infinity;
        if (distance >= bestDistance || view.hidden.has(entityKey({ kind: "source", id }))) return;
        best = { kind: "source", id };
        bestDistance = distance;
      });
    }
    return best;
  }

  #nearestLine(at: Vector2, size: Vector2, scene: PickScene, limit: number): Entity | null {
    const { preview, previewProject, view, origin } = scene;
    if (!preview || !previewProject || !view.layers.lines) return null;
    let best: Entity | null = null;
    let bestDistance = lineReach;
    previewProject.lines.forEach(({ id }, position) => {
      if (view.hidden.has(entityKey({ kind: "line", id }))) return;
      const first = preview.lineOffsets[position] ?? 0;
      const last = (preview.lineOffsets[position + 1] ?? 0) - 1;
      for (let i = first; i < last; ++i) {
        const a = this.toScreen(samplePlace(preview, i), size, origin);
        const b = this.toScreen(samplePlace(preview, i + 1), size, origin);
        if (!a || !b || Math.min(a.distance, b.distance) > limit) continue;
        const distance = distanceToSegment(at.x, at.y, a, b);
        if (distance >= bestDistance) continue;
        best = { kind: "line", id };
        bestDistance = distance;
      }
    });
    return best;
  }
}

function samplePlace({ linePoints }: ProjectPreview, sample: number): Position {
  return [linePoints[3 * sample] ?? 0, linePoints[3 * sample + 1] ?? 0, linePoints[3 * sample + 2] ?? 0];
}

interface Flat {
  readonly x: number;
  readonly y: number;
}

function distanceToSegment(x: number, y: number, a: Flat, b: Flat): number {
  const dx = b.x - a.x;
  const dy = b.y - a.y;
  const length2 = dx * dx + dy * dy;
  const along = length2 === 0 ? 0 : ((x - a.x) * dx + (y - a.y) * dy) / length2;
  const t = Math.min(1, Math.max(0, along));
  return Math.hypot(a.x + t * dx - x, a.y + t * dy - y);
}

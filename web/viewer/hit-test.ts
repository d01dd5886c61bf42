import { Raycaster, Vector2, type PerspectiveCamera } from "three";
import { entityKey, type Entity } from "../document/entities";
import type { Hit, HittableLayer } from "./layers/layer";
import type { Viewport } from "./scene-state";
import { Screen, type ScreenPoint } from "./screen";

/** Entities up to this far behind a surface count as on it; relative to the distance from the eye. */
const depthTolerance = 0.004;

export interface HitOrder {
  /** The opaque surfaces: the nearest covers everything behind it. */
  readonly solid: readonly HittableLayer[];
  /** Dots and lines, which are drawn on surfaces: the first layer that is hit wins. */
  readonly onSurfaces: readonly HittableLayer[];
  /** Translucent surfaces: hit only if nothing else is; null without any. */
  readonly translucent: HittableLayer | null;
}

/** Returns what the pointer hits: dots before lines before surfaces; null if it hits nothing. */
export function hitTest(
  { solid, onSurfaces, translucent }: HitOrder,
  camera: PerspectiveCamera,
  viewport: Viewport,
  pointer: ScreenPoint,
  isSkipped: (entity: Entity) => boolean = () => false,
): Hit | null {
  const raycaster = new Raycaster();
  const { width, height } = viewport;
  raycaster.setFromCamera(new Vector2((2 * pointer.x) / width - 1, 1 - (2 * pointer.y) / height), camera);
  const { ray } = raycaster;
  const surface = solid
    .map((layer) => layer.hit(ray, new Screen(camera, viewport, pointer, Infinity, isSkipped)))
    .reduce((nearest, hit) => (hit && (!nearest || hit.depth < nearest.depth) ? hit : nearest), null);
  const maxDepth = surface ? surface.depth * (1 + depthTolerance) : Infinity;
  const screen = new Screen(camera, viewport, pointer, maxDepth, isSkipped);
  for (const layer of onSurfaces) {
    const hit = layer.hit(ray, screen);
    if (hit) return hit;
  }
  return surface ?? translucent?.hit(ray, screen) ?? null;
}

/** Number of entities under the pointer that are found at most. */
const maxEntities = 20;

/** Returns all entities under the pointer, in the order in which `hitTest` prefers them. */
export function entitiesUnder(
  order: HitOrder,
  camera: PerspectiveCamera,
  viewport: Viewport,
  pointer: ScreenPoint,
): Entity[] {
  const found = new Map<string, Entity>();
  const isFound = (entity: Entity): boolean => found.has(entityKey(entity));
  while (found.size < maxEntities) {
    const target = hitTest(order, camera, viewport, pointer, isFound)?.target;
    if (!target || target.kind === "element") break;
    found.set(entityKey(target), target);
  }
  return [...found.values()];
}

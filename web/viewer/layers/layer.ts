import type { Object3D, Ray } from "three";
import type { Entity } from "../../document/entities";
import type { Position } from "../../document/position";
import type { SceneChanges } from "../scene-state";
import type { Screen } from "../screen";

/** A layer of the scene: draws one kind of thing and owns its GPU resources. */
export interface Layer {
  /** Added to the scene once, by the viewer. */
  readonly root: Object3D;
  /** Updates buffers and materials to the new state; the cost depends only on what has changed. */
  update(changes: SceneChanges): void;
  dispose(): void;
}

/** What a hit test finds: an entity, or a tetrahedron of the mesh. */
export type Target = Entity | { readonly kind: "element"; readonly index: number };

export interface Hit {
  readonly target: Target;
  /** Position hit, in model coordinates. */
  readonly position: Position;
  /** Distance from the eye. */
  readonly depth: number;
}

/** A layer whose contents the pointer can hit. */
export interface HittableLayer extends Layer {
  /**
   * Returns what the pointer hits: the entity drawn nearest to it on the screen, or the first triangle on the ray; null
   * without a hit, and if the layer is not shown. `ray` is in local coordinates, relative to the scene's origin.
   */
  hit(ray: Ray, screen: Screen): Hit | null;
}

/** Returns a local position in model coordinates. */
export function addOrigin(local: Position, origin: Position): Position {
  return [local[0] + origin[0], local[1] + origin[1], local[2] + origin[2]];
}

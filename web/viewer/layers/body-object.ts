import type { BodyPlacement } from "tetrafront/project";
import { DoubleSide, Group, Matrix4, type Ray } from "three";
import type { DrawnSurface } from "../../document/drawn-surface";
import { noRotation, placed } from "../../document/placement";
import type { Position } from "../../document/position";
import { EntityStates } from "../entity-states";
import type { StateMaterial } from "../draw-state";
import type { SceneState } from "../scene-state";
import type { DrawnTriangles } from "../shown-bodies";
import type { Screen } from "../screen";
import { TriangleTree, type SerializedTree } from "../triangle-tree";
import { BodyPieces } from "./body-pieces";
import type { Hit } from "./layer";

export type BuildTree = (corners: Float32Array<ArrayBuffer>) => Promise<SerializedTree>;

/** Materials of the passes, which the bodies share. */
export interface BodyMaterials {
  /** In one colour, and by each meaning of values. */
  readonly plain: StateMaterial;
  readonly deviation: StateMaterial;
  readonly patch: StateMaterial;
  readonly color: StateMaterial;
  readonly emphasized: StateMaterial;
  readonly behind: StateMaterial;
}

/** One body in the scene: its triangles, whose patches have states, where its placement moves them. */
export class BodyObject {
  readonly root = new Group();
  readonly #materials: BodyMaterials;
  readonly #states = new EntityStates("body-patch");
  readonly #pieces = new BodyPieces(this.root);
  #isSolid = false;
  #drawn: DrawnSurface | null = null;
  #tree = new TriangleTree(new Float32Array());
  #placement: BodyPlacement | undefined;

  constructor(materials: BodyMaterials) {
    this.#materials = materials;
  }

  /** Sets the triangles. */
  setTriangles({ drawn, patches, placement, values }: DrawnTriangles, buildTree: BuildTree): void {
    this.#placement = placement;
    const isSame = drawn === this.#drawn;
    this.#drawn = drawn;
    if (!drawn) {
      this.root.visible = false;
      return;
    }
    this.#states.assign(
      patches,
      Uint32Array.from(drawn.patchOffsets, (triangle) => 3 * triangle),
    );
    const { plain, emphasized, behind } = this.#materials;
    if (!isSame) {
      this.#pieces.setTriangles(drawn, [plain, emphasized, behind]);
      this.#tree = new TriangleTree(drawn.corners);
      void this.#tree.prepare(buildTree);
    }
    this.#pieces.setMaterial(drawn.values ? this.#materials[values] : plain);
  }

  /** Moves the triangles to their position relative to the scene's origin. */
  place(origin: Position): void {
    const { rotation = noRotation, scale = 1 } = this.#placement ?? {};
    const centre = placed(this.#drawn?.centre ?? [0, 0, 0], this.#placement);
    this.root.position.set(centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]);
    this.root.quaternion.set(...rotation);
    this.root.scale.setScalar(scale);
    this.root.updateMatrixWorld(true);
  }

  /** Shows the states of the patches; the triangles themselves only if `isSolid`. */
  show(state: SceneState, isVisible: boolean, isSolid: boolean): void {
    this.root.visible = isVisible && this.#drawn !== null;
    if (!this.root.visible) return;
    this.#states.update(state);
    this.#isSolid = isSolid;
    const isEmphasized = this.#states.hasAny("hover", "selected", "defective");
    const isBehind = this.#states.hasAny("selected", "defective");
    this.#pieces.show(this.#states.attribute, [isSolid, isEmphasized, isBehind]);
  }

  /** Draws more of a large surface in the next frame. Returns whether there is more. */
  drawMore(): boolean {
    return this.root.visible && this.#pieces.drawMore();
  }

  /** Returns the patch that a ray hits first, if the triangles are shown. The ray is in local coordinates of the scene. */
  hit(ray: Ray, screen: Screen): Hit | null {
    const drawn = this.#drawn;
    if (!this.root.visible || !this.#isSolid || !drawn) return null;
    const { scale = 1 } = this.#placement ?? {};
    const local = ray.clone().applyMatrix4(new Matrix4().copy(this.root.matrixWorld).invert());
    const hit = this.#tree.firstHit(local, DoubleSide, (triangle) =>
      this.#states.canHit(3 * triangle, screen),
    );
    const depth = hit ? hit.distance * scale : Infinity;
    const target = hit && this.#states.entityAt(this.#states.recordOf(3 * hit.triangle));
    if (!hit || !target || depth > screen.maxDepth) return null;
    const [x, y, z] = hit.point;
    const given: Position = [x + drawn.centre[0], y + drawn.centre[1], z + drawn.centre[2]];
    return { target, position: placed(given, this.#placement), depth };
  }

  /** Number of triangles drawn. */
  get triangleCount(): number {
    return this.root.visible && this.#isSolid ? (this.#drawn?.order.length ?? 0) : 0;
  }

  dispose(): void {
    this.#pieces.dispose();
  }
}

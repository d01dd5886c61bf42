import type { BodyPlacement } from "tetrafront";
import { BufferAttribute, BufferGeometry, DoubleSide, Group, Matrix4, Mesh, type Ray } from "three";
import type { DrawnSurface } from "../../document/drawn-surface";
import { noRotation, placed } from "../../document/placement";
import type { Position } from "../../document/position";
import { EntityStates } from "../entity-states";
import type { StateMaterial } from "../draw-state";
import type { SceneState } from "../scene-state";
import type { DrawnTriangles } from "../shown-bodies";
import type { Screen } from "../screen";
import { TriangleTree, type SerializedTree } from "../triangle-tree";
import type { Hit } from "./layer";

export type BuildTree = (corners: Float32Array<ArrayBuffer>) => Promise<SerializedTree>;

/** Materials of the passes, which the bodies share. */
export interface BodyMaterials {
  /** In one colour, and by each meaning of values. */
  readonly plain: StateMaterial;
  readonly deviation: StateMaterial;
  readonly patch: StateMaterial;
  readonly emphasized: StateMaterial;
  readonly behind: StateMaterial;
}

/** One body in the scene: its triangles, whose patches have states, where its placement moves them. */
export class BodyObject {
  readonly root = new Group();
  readonly #materials: BodyMaterials;
  readonly #states = new EntityStates("body-patch");
  #geometry = new BufferGeometry();
  readonly #base: Mesh;
  readonly #emphasized: Mesh;
  readonly #behind: Mesh;
  #drawn: DrawnSurface | null = null;
  #tree = new TriangleTree(new Float32Array());
  #placement: BodyPlacement | undefined;

  constructor(materials: BodyMaterials) {
    this.#materials = materials;
    this.#base = new Mesh(this.#geometry, materials.plain);
    this.#emphasized = new Mesh(this.#geometry, materials.emphasized);
    this.#behind = new Mesh(this.#geometry, materials.behind);
    [this.#base, this.#emphasized, this.#behind].forEach((mesh, pass) => {
      mesh.frustumCulled = false;
      mesh.renderOrder = pass === 0 ? 0 : 1 + pass;
      this.root.add(mesh);
    });
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
    if (!isSame) this.#setGeometry(drawn, buildTree);
    this.#base.material = drawn.values ? this.#materials[values] : this.#materials.plain;
    this.#geometry.setAttribute("state", this.#states.attribute);
  }

  /** Moves the triangles to their place relative to the scene's origin. */
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
    this.#base.visible = isSolid;
    this.#emphasized.visible = this.#states.hasAny("hover", "selected", "defective");
    this.#behind.visible = this.#states.hasAny("selected", "defective");
  }

  /** Returns the patch that a ray hits first, if the triangles are shown. The ray is in local coordinates of the scene. */
  hit(ray: Ray, screen: Screen): Hit | null {
    const drawn = this.#drawn;
    if (!this.root.visible || !this.#base.visible || !drawn) return null;
    const { scale = 1 } = this.#placement ?? {};
    const local = ray.clone().applyMatrix4(new Matrix4().copy(this.root.matrixWorld).invert());
    const hit = this.#tree.firstHit(local, DoubleSide, (triangle) => this.#states.isDrawn(3 * triangle));
    const depth = hit ? hit.distance * scale : Infinity;
    const target = hit && this.#states.entityAt(this.#states.recordOf(3 * hit.triangle));
    if (!hit || !target || depth > screen.maxDepth) return null;
    const [x, y, z] = hit.point;
    const given: Position = [x + drawn.centre[0], y + drawn.centre[1], z + drawn.centre[2]];
    return { target, position: placed(given, this.#placement), depth };
  }

  /** Number of triangles drawn. */
  get triangleCount(): number {
    return this.root.visible && this.#base.visible ? (this.#drawn?.order.length ?? 0) : 0;
  }

  dispose(): void {
    this.#geometry.dispose();
  }

  #setGeometry({ corners, values }: DrawnSurface, buildTree: BuildTree): void {
    this.#geometry.dispose();
    this.#geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
    if (values) this.#geometry.setAttribute("value", new BufferAttribute(values, 1));
    for (const mesh of [this.#base, this.#emphasized, this.#behind]) mesh.geometry = this.#geometry;
    this.#tree = new TriangleTree(corners);
    void this.#tree.prepare(buildTree);
  }
}

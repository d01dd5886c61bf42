import { addBackgroundNode, offerTetrahedron } from "../../document/create";
import type { Place } from "../../document/draw";
import { findRecord, type Entity } from "../../document/entities";
import { likelySize } from "../../document/extent";
import type { Position } from "../../document/position";
import { distance } from "../../document/vectors";
import { emptySketch, type Sketch } from "../../viewer/layers/drawing-layer";
import type { ToolPointer } from "../interaction";
import { DrawingTool, type DrawingStores } from "./drawing-tool";
import { snapToModel, type Snap } from "./snapping";

const nodeOf = (id: number): Entity => ({ kind: "background-node", id });

/**
 * Builds the background grid: a click picks the node under the pointer, or adds one. Four picked nodes become a tetrahedron.
 * A second click on a picked node leaves it out.
 */
export class NodeTool extends DrawingTool {
  readonly #all: DrawingStores;
  /** Ids of the picked nodes. */
  #picked: readonly number[] = [];

  constructor(stores: DrawingStores) {
    super(stores);
    this.#all = stores;
  }

  get picked(): number {
    return this.#nodes.length;
  }

  override overlay() {
    this.stores.view.reveal("background-node");
    return super.overlay();
  }

  /** Nodes of the grid come before everything else. */
  protected override snapAt(pointer: ToolPointer): Snap | null {
    const { nodes } = this.project.background;
    const seen = this.#all.viewer.seenFrom(pointer.at);
    const snap = pointer.mod ? null : snapToModel({ points: nodes, lines: [] }, seen);
    return snap ? { ...snap, kind: "node" } : super.snapAt(pointer);
  }

  protected pick({ position }: Place): void {
    const { nodes } = this.project.background;
    const found = nodes.find((node) => distance(node.position, position) === 0);
    const picked = this.#nodes.map(({ id }) => id);
    if (!found) this.#picked = [...picked, this.#add(position)];
    else if (picked.includes(found.id)) this.#picked = picked.filter((id) => id !== found.id);
    else this.#picked = [...picked, found.id];
    if (this.#picked.length === 4) this.#join();
    else this.stores.view.selectAll(this.#picked.map(nodeOf));
  }

  protected last(): Position | null {
    return this.#nodes.at(-1)?.position ?? null;
  }

  protected finish(): void {
    this.#picked = [];
  }

  protected removeLast(): boolean {
    const hadNodes = this.#nodes.length > 0;
    this.#picked = this.#picked.slice(0, -1);
    return hadNodes;
  }

  protected leave(): boolean {
    const hadNodes = this.#nodes.length > 0;
    this.#picked = [];
    return hadNodes;
  }

  protected sketch(): Sketch {
    const picked = this.#nodes.map(({ position }) => position);
    const next = this.snap?.position;
    const corners = next ? [...picked, next] : picked;
    const paths = corners.flatMap((a, i) => corners.slice(i + 1).map((b) => [a, b]));
    return { ...emptySketch, paths, dots: next && this.snap?.kind !== "node" ? [next] : [] };
  }

  protected override end(): void {
    this.#picked = [];
    super.end();
  }

  /** The picked nodes that undo has not removed. */
  get #nodes() {
    return this.#picked.flatMap((id) => findRecord(this.project, "background-node", id) ?? []);
  }

  /** A new node takes the size of the one picked before; the first one, the uniform size. */
  #add(position: Position): number {
    const size = this.#nodes.at(-1)?.size ?? this.project.meshing?.size ?? likelySize(this.project);
    const creation = addBackgroundNode(this.project, position, size);
    this.create(creation);
    return creation.entities[0]?.id ?? 0;
  }

  #join(): void {
    const offer = offerTetrahedron(this.project, this.#picked.map(nodeOf));
    if (offer.possible) this.create(offer.creation);
    else this.stores.drawing.state.setState({ refused: offer.reason });
    this.#picked = offer.possible ? [] : this.#picked.slice(0, -1);
  }
}

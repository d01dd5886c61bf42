import { offerPatch, type Offer } from "../../document/create";
import type { Entity } from "../../document/entities";
import { firstLoop, type LoopUse } from "../../document/loop-hits";
import type { LinePath } from "../../document/line-paths";
import { fanOf } from "../../document/loop-search";
import { fillableLoops, offerFill, type FillableLoops } from "../../document/splits/loops-across";
import type { Position } from "../../document/position";
import { frameAlong, fromFrame, toFrame } from "../../document/vectors";
import { emptySketch, type Sketch } from "../../viewer/layers/drawing-layer";
import { triangulated } from "../../viewer/triangulated";
import type { ToolPointer } from "../interaction";
import { DrawingTool } from "./drawing-tool";
import type { Snap } from "./snapping";

/**
 * Fills loops of lines with patches: the loop under the pointer by a click, or lines that were clicked one by one by Enter. A
 * loop inside a planar patch becomes a hole of it; a second click fills the hole.
 */
export class PatchTool extends DrawingTool {
  override readonly takesCoordinates = false;
  #loops: { readonly paths: readonly LinePath[]; readonly loops: FillableLoops } | null = null;
  #hovered: LoopUse | null = null;

  /** The picked lines are the selected ones. */
  get picked(): number {
    return this.#lines.length;
  }

  override up(pointer: ToolPointer): boolean {
    this.stores.drawing.state.setState({ refused: null });
    if (pointer.button === "right") this.finish();
    else if (pointer.button === "left") {
      this.snap = this.snapAt(pointer);
      if (this.snap?.kind === "line") this.#toggle(this.snap);
      else if (this.#hovered) this.#fill(this.#hovered);
      this.snap = this.snapAt(pointer);
    }
    this.refresh(pointer);
    return true;
  }

  /** The pointer snaps to lines, and finds the loop around it. */
  protected override snapAt(pointer: ToolPointer): Snap | null {
    const target = pointer.hit()?.target;
    const { ray } = this.stores.viewer.seenFrom(pointer.at);
    const { uses } = this.#fillable;
    const found = firstLoop(
      uses.map(({ loop }) => loop),
      ray,
    );
    this.#hovered = uses.find(({ loop }) => loop === found) ?? null;
    const position = pointer.hit()?.position;
    if (target?.kind !== "line" || !position) return null;
    return { kind: "line", id: target.id, position };
  }

  protected pick(): void {
    // Patches have no places.
  }

  protected last(): Position | null {
    return null;
  }

  protected finish(): void {
    const { selection } = this.stores.view.state.getState();
    if (this.#lines.length > 0) this.#take(offerPatch(this.project, selection, null));
  }

  protected removeLast(): boolean {
    const lines = this.#lines;
    this.stores.view.selectAll(lines.slice(0, -1));
    return lines.length > 0;
  }

  protected leave(): boolean {
    const hadLines = this.#lines.length > 0;
    if (hadLines) this.stores.view.clear();
    return hadLines;
  }

  protected sketch(): Sketch {
    if (this.snap || !this.#hovered) return emptySketch;
    const { polygon, holePolygons, normal } = this.#hovered.loop;
    const outlines = [polygon, ...holePolygons];
    return {
      dots: [],
      paths: outlines.map((outline) => [...outline, ...outline.slice(0, 1)]),
      triangles: normal ? filled(outlines, normal) : fanOf(polygon),
    };
  }

  get #lines(): readonly Entity[] {
    return this.stores.view.state.getState().selection.filter(({ kind }) => kind === "line");
  }

  get #fillable(): FillableLoops {
    const { paths } = this;
    if (this.#loops?.paths !== paths) this.#loops = { paths, loops: fillableLoops(this.project, paths) };
    return this.#loops.loops;
  }

  #toggle({ id }: Snap): void {
    if (id === null) return;
    if (this.stores.view.state.getState().selection.some(({ kind }) => kind !== "line"))
      this.stores.view.clear();
    this.stores.view.select({ kind: "line", id }, "toggle");
  }

  #fill(use: LoopUse): void {
    this.#take(offerFill(this.project, this.#fillable, use));
  }

  #take(offer: Offer): void {
    if (offer.possible) this.create(offer.creation);
    else this.stores.drawing.state.setState({ refused: offer.reason });
  }
}

/** Returns triangles that fill a polygon with holes. */
function filled(outlines: readonly (readonly Position[])[], normal: Position): readonly Position[] {
  const frame = frameAlong(normal, outlines[0]?.[0]);
  const flat = outlines.map((outline) => outline.map((position) => toFrame(frame, position)));
  return triangulated(flat).map(([x, y]) => fromFrame(frame, [x, y, 0]));
}

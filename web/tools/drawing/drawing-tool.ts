import type { Creation } from "../../document/create";
import { placeAt, placeOnLines, type Place } from "../../document/draw";
import { entityKey } from "../../document/entities";
import { expressionFrom } from "../../document/expression-edits";
import { projectNumbers } from "../../document/length-units";
import { linePaths, type LinePath } from "../../document/line-paths";
import type { Position } from "../../document/position";
import { valuesOf, type QuantityPosition } from "../../document/quantity-positions";
import type { ViewStore } from "../../document/selection";
import { fromFrame, toFrame, type Frame } from "../../document/vectors";
import { planeOfPatch } from "../../document/patch-planes";
import { onPlane, planeAlong, roundStep, roundTo, type Ray } from "../../document/work-plane";
import { readNumber } from "../../expressions/expression";
import { quantity, type Quantity } from "../../expressions/quantity";
import type { DocumentStore } from "../../session/document-store";
import type { PreviewFeed } from "../../session/preview";
import { DrawingLayer, type Sketch } from "../../viewer/layers/drawing-layer";
import type { Layer } from "../../viewer/layers/layer";
import { PlaneGridLayer } from "../../viewer/layers/plane-grid-layer";
import type { ScreenPoint } from "../../viewer/screen";
import type { Viewer } from "../../viewer/viewer";
import type { Interaction, ToolPointer } from "../interaction";
import { Overlay } from "../overlay";
import { readCoordinates } from "./coordinates";
import type { Drawing, DrawingState, TypedInput } from "./drawing";
import { snapToModel, type Snap, type SnapTargets } from "./snapping";
import { TypedKeys } from "./typed-keys";

/** The parts of the app that drawing tools use. */
export interface DrawingStores {
  readonly documents: DocumentStore;
  readonly previews: PreviewFeed;
  readonly view: ViewStore;
  readonly drawing: Drawing;
  readonly viewer: Pick<Viewer, "seenFrom" | "pixelLength" | "requestFrame">;
  /** Receives the keys that may begin coordinates. All tools of a view share it. Without it, letters run no commands. */
  readonly keys?: TypedKeys;
  /** Tells the user something about what was made. */
  readonly inform?: (text: string) => void;
}

/** Smallest distance between lines of the work plane's grid, in CSS pixels. */
const gridPixels = 20;

/**
 * What the drawing tools have in common: places under the pointer, typed coordinates, the sketch and the grid. While some are
 * `picked`, a double click finishes, and a button offers it. Escape and Backspace go on to the commands if `leave` and `removeLast`
 * return false. The object lives on while another tool is active: `end` forgets what must not be continued.
 */
export abstract class DrawingTool implements Interaction, TypedInput {
  protected readonly stores: DrawingStores;
  protected snap: Snap | null = null;
  /** The last place under the pointer, which may have left the view since. */
  protected seen: Position | null = null;
  readonly #keys: TypedKeys;
  /** The place under the pointer, while one that is typed is shown instead. */
  #pointed: Snap | null = null;
  #layer: DrawingLayer | null = null;
  #stopListening: (() => void) | null = null;
  #paths: { readonly key: readonly unknown[]; readonly paths: readonly LinePath[] } | null = null;

  constructor(stores: DrawingStores) {
    this.stores = stores;
    const { drawing, documents } = stores;
    const named = () => projectNumbers(documents.project);
    this.#keys = stores.keys ?? new TypedKeys({ drawing, named, hotkeyOf: () => null });
  }

  /** Uses a place that was clicked or typed. */
  protected abstract pick(place: Place, pointer: ToolPointer | null): void;
  /** The place picked last, to which typed coordinates refer. */
  protected abstract last(): QuantityPosition | null;
  /** Ends what is being drawn, by Enter or a double click. */
  protected abstract finish(): void;
  /** Removes the place picked last. Returns false if there is none. */
  protected abstract removeLast(): boolean;
  /** Leaves what is being drawn. Returns false if nothing is. */
  protected abstract leave(): boolean;
  /** Returns what a click at the snapped place would create. */
  protected abstract sketch(): Sketch;
  readonly takesCoordinates: boolean = true;
  /** Whether there are picked places that belong to no step of undo. */
  get canTakeBack(): boolean {
    return false;
  }

  /** Number of places picked for what is being drawn. */
  protected abstract get picked(): number;

  down(): boolean {
    // The press may already belong to another tool.
    this.#keys.flush();
    return false;
  }

  move(pointer: ToolPointer | null): boolean {
    if (pointer && this.#keys.flushAt(pointer.at)) return true;
    const pointed = pointer && this.snapAt(pointer);
    this.seen = pointed?.position ?? this.seen;
    if (isTyped(this.snap)) {
      // The hand may rest on the mouse: what is typed stays shown. An arc lies on the side of the pointer.
      this.#pointed = pointed;
      this.snap = this.#typedSnap(this.stores.drawing.state.getState().typed ?? "") ?? pointed;
    } else this.snap = pointed;
    this.refresh(pointer);
    return pointed !== null;
  }

  up(pointer: ToolPointer): boolean {
    this.stores.drawing.state.setState({ refused: null });
    this.stores.drawing.letters = "";
    if (pointer.button === "right") this.finish();
    if (pointer.button === "left") {
      this.snap = this.snapAt(pointer);
      // After a loop was closed, a click at the same place begins the next line.
      if (pointer.clicks > 1 && this.picked > 0) this.finish();
      else if (this.snap) this.pick(this.placeOf(this.snap), pointer);
    }
    this.refresh(pointer);
    return true;
  }

  cancel(): void {
    this.snap = null;
    this.refresh(null);
  }

  key(event: KeyboardEvent): boolean {
    // Many keyboards type @ with AltGr, which counts as Ctrl and Alt.
    if ((event.ctrlKey || event.metaKey || event.altKey) && event.key !== "@") {
      this.#keys.flush();
      return false;
    }
    this.stores.drawing.state.setState({ refused: null });
    const isUsed = this.#useKey(event);
    if (isUsed) this.refresh(null);
    return isUsed;
  }

  take(text: string): DrawingState["mistake"] {
    const named = projectNumbers(this.project);
    const number = readNumber(text, named);
    const used = number === null ? undefined : this.takeNumber(quantity(number, expressionFrom(text)));
    if (used !== undefined) {
      if (used === null) this.snap = null;
      this.refresh(null);
      return used;
    }
    const typed = readCoordinates(text, { last: this.last(), frame: this.frame, named });
    if (!typed.success) return typed.reason;
    this.snap = null;
    this.pick(placeAt(this.stores.documents.project, typed.position, typed.expressions), null);
    this.refresh(null);
    return null;
  }

  /** Shows what the text would create. While it has no meaning, the place under the pointer is shown. */
  edited(text: string): string {
    if (!isTyped(this.snap)) this.#pointed = this.snap;
    this.snap = this.#typedSnap(text) ?? this.#pointed;
    this.refresh(null);
    return text;
  }

  closed(): void {
    if (!isTyped(this.snap)) return;
    this.snap = this.#pointed;
    this.refresh(null);
  }

  takeBack(): void {
    if (this.canTakeBack) this.removeLast();
    this.refresh(null);
  }

  complete(): void {
    this.finish();
    this.refresh(null);
  }

  /** If the pointer is not over the view, beside the place picked last, or the origin of the work plane. */
  placeOfField(): ScreenPoint | null {
    const { drawing, viewer } = this.stores;
    if (drawing.state.getState().cursor) return null;
    const last = this.last();
    return viewer.seenFrom({ x: 0, y: 0 }).toScreen(last ? valuesOf(last) : this.frame.origin);
  }

  overlay(): Layer {
    this.stores.drawing.begin(this);
    this.#stopListening = this.stores.documents.onProject(() => this.refresh(null));
    this.#layer = new DrawingLayer();
    const grid = new PlaneGridLayer(() => this.gridStep);
    return new Overlay([grid, this.#layer], { onDispose: () => this.end() });
  }

  /** Uses a typed number. Returns why it cannot be used; null if it was; undefined if it has no meaning. */
  protected takeNumber(_number: Quantity): DrawingState["mistake"] | undefined {
    return undefined;
  }

  /** Returns a place on what a typed number would create; null if it would create nothing. */
  protected placeOfNumber(_number: number): Position | null {
    return null;
  }

  /** The tool is put away. */
  protected end(): void {
    this.#keys.drop();
    this.#layer = null;
    this.#stopListening?.();
    this.stores.drawing.end();
  }

  protected get project() {
    return this.stores.documents.project;
  }

  protected get frame(): Frame {
    return this.stores.view.state.getState().workPlane.frame;
  }

  protected get gridStep(): number {
    return roundStep(gridPixels * this.stores.viewer.pixelLength);
  }

  /** The courses of all lines, computed once per state of the project. */
  protected get paths(): readonly LinePath[] {
    const { preview, project: sampled } = this.stores.previews.state.getState();
    const key = [this.project, preview];
    if (!this.#paths || this.#paths.key.some((part, i) => part !== key[i])) {
      const known = preview && sampled && { samples: preview, project: sampled };
      this.#paths = { key, paths: linePaths(this.project, known) };
    }
    return this.#paths.paths;
  }

  /** Adds what was drawn as one step of undo, and selects it. */
  protected create({ edit, entities, note }: Creation): void {
    this.stores.documents.edit(edit);
    this.stores.view.selectAll(entities);
    if (note !== undefined) this.stores.inform?.(note);
  }

  protected placeOf({ kind, id, position, lines }: Snap): Place {
    if (lines) return placeOnLines(this.project, lines, position);
    if (kind === "point") return { point: id, position };
    return { ...placeAt(this.project, position), ...(kind === "patch" && id !== null && { patch: id }) };
  }

  /** Returns the place under the pointer; null if the pointer sees neither the model nor the work plane. */
  protected snapAt(pointer: ToolPointer): Snap | null {
    const { snapping } = this.stores.view.state.getState();
    const seen = this.stores.viewer.seenFrom(pointer.at);
    const onModel = snapping.model && !pointer.mod ? snapToModel(this.targets(), seen) : null;
    if (onModel) return onModel;
    const inPlane = onPlane(seen.ray, this.frame);
    const hit = snapping.patches ? pointer.hit() : null;
    if (hit?.target.kind === "patch" && isNearer(seen.ray, hit.position, inPlane)) {
      return this.#onPatch(hit.target.id, hit.position, seen.ray, pointer.mod);
    }
    if (!inPlane) return null;
    const isOnGrid = snapping.grid && !pointer.mod;
    const position = isOnGrid ? roundInFrame(this.frame, inPlane, this.gridStep) : inPlane;
    return { kind: isOnGrid ? "grid" : "plane", id: null, position };
  }

  /** What the pointer snaps to. */
  protected targets(): SnapTargets {
    const { hidden, layers } = this.stores.view.state.getState();
    const { points } = this.project;
    const lines = layers.lines ? this.paths : [];
    if (hidden.size === 0) return { points: layers.points ? points : [], lines };
    return {
      points: layers.points ? points.filter(({ id }) => !hidden.has(entityKey({ kind: "point", id }))) : [],
      lines: lines.filter(({ line }) => !hidden.has(entityKey({ kind: "line", id: line.id }))),
    };
  }

  /** Shows what a click would create. */
  protected refresh(pointer: ToolPointer | null): void {
    // A key may have taken another tool.
    if (!this.#layer) return;
    const { drawing, viewer } = this.stores;
    drawing.state.setState({
      snap: this.snap,
      picked: this.picked,
      canTakeBack: this.canTakeBack,
      gridStep: this.gridStep,
      ...(pointer && { pointer: pointer.at }),
    });
    this.#layer.show(this.sketch());
    viewer.requestFrame();
  }

  #useKey(event: KeyboardEvent): boolean {
    if (this.takesCoordinates && this.#keys.use(event)) return true;
    switch (event.key) {
      case "Enter":
        this.finish();
        return true;
      case "Backspace":
        return this.removeLast();
      case "Escape":
        return this.leave();
      default:
        return false;
    }
  }

  #typedSnap(text: string): Snap | null {
    const named = projectNumbers(this.project);
    const number = readNumber(text, named);
    const on = number === null ? null : this.placeOfNumber(number);
    if (on) return { kind: "radius", id: null, position: on };
    const typed = readCoordinates(text, { last: this.last(), frame: this.frame, named });
    return typed.success ? { kind: "typed", id: null, position: valuesOf(typed.position) } : null;
  }

  /** On planar patches, the grid of the patch's plane applies. */
  #onPatch(id: number, position: Position, ray: Ray, isFree: boolean): Snap {
    const found = planeOfPatch(this.project, id);
    const plane = found && planeAlong(found.normal, found.corner);
    const exact = plane && onPlane(ray, plane.frame);
    if (!plane || !exact) return { kind: "patch", id, position };
    const { grid } = this.stores.view.state.getState().snapping;
    const isOnGrid = grid && !isFree;
    return {
      kind: "patch",
      id,
      position: isOnGrid ? roundInFrame(plane.frame, exact, this.gridStep) : exact,
    };
  }
}

const isTyped = (snap: Snap | null): boolean => snap?.kind === "typed" || snap?.kind === "radius";

/** Returns the node of a plane's grid that is nearest to a position in the plane. */
function roundInFrame(frame: Frame, position: Position, step: number): Position {
  const [x, y] = toFrame(frame, position);
  return fromFrame(frame, [roundTo(x, step), roundTo(y, step), 0]);
}

/** Returns whether a position is nearer to the eye than another, or equally near. */
function isNearer({ origin }: Ray, a: Position, b: Position | null): boolean {
  if (!b) return true;
  const square = (p: Position): number => p.reduce((sum, x, k) => sum + (x - (origin[k] ?? 0)) ** 2, 0);
  return square(a) < square(b) * (1 - 1e-6);
}

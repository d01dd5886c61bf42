import type { Project } from "tetrafront/project";
import type { Offer } from "../document/create";
import type { Entity } from "../document/entities";
import { coordinatesOf } from "../document/expression-edits";
import type { Position } from "../document/position";
import { quantityPosition } from "../document/quantity-positions";
import type { ViewStore } from "../document/selection";
import type { HandleMode } from "../document/tools";
import { translation, type Affine } from "../document/transforms/affine";
import { transformer, transformStep } from "../document/transforms/transform";
import { unit, zero } from "../document/vectors";
import { projectNumbers } from "../document/length-units";
import type { DocumentStore, Gesture } from "../session/document-store";
import type { ScreenPoint } from "../viewer/screen";
import type { Viewer } from "../viewer/viewer";
import type { Drawing, DrawingState, TypedInput } from "./drawing/drawing";
import type { TypedKeys } from "./drawing/typed-keys";
import { axisOfKey, nextNumber, readMotion, type Axis } from "./typed-motion";

export interface MotionStores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly drawing: Drawing;
  readonly keys: TypedKeys;
  readonly viewer: Pick<Viewer, "seenFrom">;
  /** Tells the user something about what was made. */
  readonly inform?: (text: string) => void;
}

export interface MotionStart {
  readonly mode: HandleMode;
  readonly selection: readonly Entity[];
  /** The point that was taken hold of, or the middle of the selection. */
  readonly base: Position;
  /** The axis of the handle; null without one. */
  readonly axis: Axis | null;
  /** Whether a button of the pointer is held. */
  readonly isHeld: boolean;
}

interface Run extends MotionStart {
  readonly project: Project;
  readonly offer: ReturnType<typeof transformer>;
  /** Begins with the first change. */
  gesture: Gesture | null;
  /** What the pointer has done so far. */
  dragged: Affine | null;
}

const changes = { translate: "move", rotate: "rotate", scale: "scale" } as const satisfies {
  [M in HandleMode]: string;
};

/**
 * Moves, rotates or scales entities by the pointer or by typed numbers, as one step of undo. While a field shows what was
 * typed, the numbers decide, also after the button was released: Enter accepts them, Escape cancels. X, Y and Z choose an
 * axis. What coincides afterwards is joined.
 */
export class Motion implements TypedInput {
  readonly takesCoordinates = false;
  readonly #stores: MotionStores;
  #run: Run | null = null;
  #axis: Axis | null = null;

  constructor(stores: MotionStores) {
    this.#stores = stores;
  }

  get isRunning(): boolean {
    return this.#run !== null;
  }

  get isTyping(): boolean {
    return this.#run !== null && this.#stores.drawing.state.getState().typed !== null;
  }

  /** The axis that was chosen by a key; null without one. */
  get axis(): Axis | null {
    return this.#axis;
  }

  /** Ends what runs, and begins. */
  start(start: MotionStart): void {
    this.cancel();
    // The command of a waiting letter must not run during a drag.
    if (start.isHeld) this.#stores.keys.drop();
    const { project } = this.#stores.documents;
    const offer = transformer(project, start.selection);
    this.#run = { ...start, project, offer, gesture: null, dragged: null };
    this.#stores.drawing.beginMotion(this, start.mode);
  }

  /** Shows what the pointer does, with its amount beside it. Does nothing while numbers are typed. */
  drag(map: Affine, amount: string, pointer: ScreenPoint): void {
    if (!this.#run || this.isTyping) return;
    this.#run.dragged = map;
    this.#show(this.#run, map, false);
    this.#stores.drawing.state.setState({ pointer, amount });
  }

  /** The button was released: the motion is accepted, unless numbers are typed. */
  release(): void {
    const run = this.#run;
    if (!run) return;
    if (this.isTyping) this.#run = { ...run, isHeld: false };
    else if (run.dragged) this.#accept(run, run.dragged);
    else this.cancel();
  }

  /** Restores everything as it was. */
  cancel(): void {
    const run = this.#run;
    if (!run) return;
    this.#end();
    run.gesture?.cancel();
  }

  /** Returns whether a motion uses a key. `start` is called for a motion without the pointer. */
  key(event: KeyboardEvent, start: () => MotionStart | null): boolean {
    const { keys } = this.#stores;
    // Many keyboards type @ with AltGr, which counts as Ctrl and Alt.
    if ((event.ctrlKey || event.metaKey || event.altKey) && event.key !== "@") return false;
    const begun = this.#run ? null : start();
    if (begun) this.start(begun);
    if (!this.#run) return false;
    if (this.#run.isHeld && event.key === "Enter" && !this.isTyping) {
      this.release();
      return true;
    }
    const axis = this.isTyping ? null : axisOfKey(event.key);
    // During a drag, no key runs a command.
    const isUsed = axis !== null || keys.use(event, !this.#run.isHeld);
    if (axis !== null) this.#choose(axis);
    this.#forgetIdle();
    return isUsed;
  }

  /** A key that opened no field began nothing, nor did a letter that waits: it may become a command that changes all. */
  #forgetIdle(): void {
    if (this.#run?.isHeld === false && !this.isTyping) this.cancel();
  }

  /** Without the pointer, beside the middle of the selection. */
  placeOfField(): ScreenPoint | null {
    const run = this.#run;
    if (!run || run.isHeld) return null;
    return this.#stores.viewer.seenFrom({ x: 0, y: 0 }).toScreen(run.base);
  }

  edited(text: string): string {
    const axis = axisOfKey(text.trim());
    if (axis !== null) this.#axis = this.#axis === axis ? null : axis;
    const shown = axis === null ? text : "";
    this.#stores.drawing.state.setState({ axis: this.#axis });
    if (this.#run) this.#preview(this.#run, shown);
    return shown;
  }

  next(text: string): string {
    const next = nextNumber(text, this.#run?.mode ?? null, this.#axis);
    if (next === text) return text;
    this.#axis = null;
    this.#stores.drawing.state.setState({ axis: null });
    return next;
  }

  /** The field was closed without Enter. While the button is held, the pointer decides again. */
  closed(): void {
    if (this.#run?.isHeld === false) this.cancel();
  }

  take(text: string): DrawingState["mistake"] {
    if (!this.#run) return null;
    const read = this.#read(this.#run, text);
    if (!read.success) return read.reason;
    if (!this.#show(this.#run, read.map, false).possible) return "refused";
    this.#accept(this.#run, read.map);
    return null;
  }

  /** Without the pointer, the field shows the chosen axis. */
  #choose(axis: Axis): void {
    this.#axis = this.#axis === axis ? null : axis;
    this.#stores.drawing.state.setState({ axis: this.#axis });
    if (this.#run?.isHeld === false) this.#stores.drawing.type("");
  }

  #preview(run: Run, text: string): void {
    if (text.trim() === "") {
      if (run.gesture) this.#show(run, translation(zero), false);
      else this.#refuse(null);
      return;
    }
    const read = this.#read(run, text);
    // A number that is not complete yet changes nothing.
    if (read.success) this.#show(run, read.map, false);
  }

  #read({ mode, base, axis, dragged, project, selection }: Run, text: string) {
    const { documents, view } = this.#stores;
    const [only, ...others] = selection;
    const isPoint = only?.kind === "point" && others.length === 0;
    return readMotion(text, {
      mode,
      base,
      point: isPoint ? quantityPosition(base, coordinatesOf(project, only.id)) : null,
      axis: this.#axis ?? axis,
      direction: dragged && directionOf(dragged, mode),
      frame: view.state.getState().workPlane.frame,
      named: projectNumbers(documents.project),
    });
  }

  #accept(run: Run, map: Affine): void {
    const offer = this.#show(run, map, true);
    this.#end();
    if (!offer.possible) return run.gesture?.cancel();
    run.gesture?.commit();
    if (offer.creation.note !== undefined) this.#stores.inform?.(offer.creation.note);
  }

  /** Shows what a motion gives, or says why it is not possible. */
  #show(run: Run, map: Affine, join: boolean): Offer {
    const { documents } = this.#stores;
    const label = transformStep(changes[run.mode], run.selection);
    const offer = run.offer(map, { label, join });
    if (offer.possible) {
      run.gesture ??= documents.begin(label);
      run.gesture.update(offer.creation.edit);
    } else {
      // What was shown before would look like the result. The gesture goes on: others must not edit the project meanwhile.
      run.gesture?.update({ change: () => undefined });
    }
    this.#refuse(offer.possible ? null : offer.reason);
    return offer;
  }

  #refuse(refused: string | null): void {
    const { state } = this.#stores.drawing;
    if (state.getState().refused !== refused) state.setState({ refused });
  }

  #end(): void {
    this.#run = null;
    this.#axis = null;
    this.#stores.drawing.endMotion(this);
  }
}

/** Returns the direction of a translation, or the axis of a rotation; null if there is none. */
function directionOf({ offset, similarity }: Affine, mode: HandleMode): Position | null {
  if (mode === "translate") return unit(offset);
  if (mode === "scale" || !similarity) return null;
  const [x, y, z] = similarity.rotation;
  return unit([x, y, z]);
}

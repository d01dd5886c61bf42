import type { Project } from "tetrafront/project";
import { bodyForPatch, findRecord, sameEntity, type Entity } from "../document/entities";
import { linePaths } from "../document/line-paths";
import type { Position } from "../document/position";
import type { ViewState, ViewStore } from "../document/selection";
import { translation } from "../document/transforms/affine";
import { selectedParts } from "../document/transforms/selected-parts";
import { offerTransform } from "../document/transforms/transform";
import {
  axisDirections,
  dot,
  fromFrame,
  subtract,
  toFrame,
  unit,
  zero,
  type Frame,
} from "../document/vectors";
import { onLine, onPlane, roundStep, roundTo } from "../document/work-plane";
import type { DocumentStore } from "../session/document-store";
import { strings } from "../strings";
import { formatPosition } from "../strings/format";
import type { Viewer } from "../viewer/viewer";
import { snapToModel, type SnapTargets } from "./drawing/snapping";
import type { Interaction, ToolPointer } from "./interaction";
import type { Motion } from "./motion";

export interface DragStores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly motion: Motion;
  readonly viewer: Pick<Viewer, "seenFrom" | "pixelLength">;
}

/** Smallest step of a drag and of an arrow key, in CSS pixels. */
const stepPixels = 10;

/** Returns the step of a drag and of an arrow key, in the unit of the project. */
export const gridStep = ({ pixelLength }: Pick<Viewer, "pixelLength">): number =>
  roundStep(stepPixels * pixelLength);

/** A smaller offset, relative to the coordinates, is their rounding error: a drag in a plane does not leave it. */
const roundingShare = 1e-13;
/** Below this sine of the angle between the line of sight and the work plane, a drag moves parallel to the view. */
const flattest = 0.2;

/** A press on something selected. */
interface Drag {
  /** Where the pointer took hold: the point itself, or a place on a line or patch. */
  readonly start: Position;
  /** The plane of the drag, through `start`. */
  readonly plane: Frame;
  /**
   * What does not move, for a point under the pointer to snap to: its position goes to the grid or to the model. Null if
   * something else is under the pointer, which moves by multiples of the grid's step.
   */
  readonly targets: SnapTargets | null;
}

/** What a press takes hold of. */
export interface Hold {
  /** Returns what a drag of an entity moves; null for nothing. */
  readonly moved: (target: Entity, view: ViewState, project: Project) => readonly Entity[] | null;
  /** Whether a press on an entity that is not selected selects it. */
  readonly selects: boolean;
}

const isSelected = ({ selection }: ViewState, target: Entity): boolean =>
  selection.some((entity) => sameEntity(entity, target));

/** Whatever lies under the pointer, with the selection if it is selected. */
export const holdAll: Hold = {
  moved: (target, view) => (isSelected(view, target) ? view.selection : [target]),
  selects: true,
};

/** Only points that are selected, or belong to a selected line. */
export const holdPoints: Hold = {
  moved(target, view, project) {
    if (target.kind !== "point" || view.several) return null;
    if (isSelected(view, target)) return view.selection;
    const isOfLine = view.selection.some(
      ({ kind, id }) => kind === "line" && findRecord(project, "line", id)?.points.includes(target.id),
    );
    return isOfLine ? [target] : null;
  },
  selects: false,
};

/**
 * Drags what a press takes hold of in the work plane, or parallel to the view if that plane is seen from its edge. Shift
 * keeps to one axis, Ctrl turns snapping off. Numbers may be typed. What coincides after the drag is joined. A press that
 * does not become a drag is a click for the interactions that follow.
 */
export class DragTool implements Interaction {
  readonly #stores: DragStores;
  readonly #hold: Hold;
  #drag: Drag | null = null;

  constructor(stores: DragStores, hold: Hold) {
    this.#stores = stores;
    this.#hold = hold;
  }

  down(pointer: ToolPointer): boolean {
    this.#drag = pointer.button === "left" && !pointer.mod && !pointer.shift ? this.#begin(pointer) : null;
    return this.#drag !== null;
  }

  move(pointer: ToolPointer | null): boolean {
    const offset = this.#drag && pointer?.isDrag === true ? this.#offsetAt(pointer, this.#drag) : null;
    if (!pointer || !offset) return false;
    const amount = strings.drawing.amounts.translate(formatPosition(offset));
    this.#stores.motion.drag(translation(offset), amount, pointer.at);
    return true;
  }

  up(pointer: ToolPointer): boolean {
    const { motion } = this.#stores;
    const drag = this.#drag;
    this.#drag = null;
    if (!drag) return false;
    // Enter may have ended the motion before.
    const isUsed = pointer.isDrag || motion.isTyping || !motion.isRunning;
    if (isUsed) motion.release();
    else motion.cancel();
    return isUsed;
  }

  cancel(): void {
    if (this.#drag) this.#stores.motion.cancel();
    this.#drag = null;
  }

  key(event: KeyboardEvent): boolean {
    const { motion } = this.#stores;
    return motion.isRunning && motion.key(event, () => null);
  }

  get #step(): number {
    return gridStep(this.#stores.viewer);
  }

  get #frame(): Frame {
    return this.#stores.view.state.getState().workPlane.frame;
  }

  #begin(pointer: ToolPointer): Drag | null {
    const { documents, view, viewer, motion } = this.#stores;
    // A press must not end the preview of an operation.
    if (documents.state.getState().gestureStart !== null) return null;
    const hit = pointer.hit();
    if (!hit || hit.target.kind === "element") return null;
    const { project } = documents;
    const target = bodyForPatch(project, hit.target);
    const moved = this.#hold.moved(target, view.state.getState(), project);
    const none = { label: "", join: false };
    if (!moved || !offerTransform(project, moved, translation(zero), none).possible) return null;
    if (this.#hold.selects && !isSelected(view.state.getState(), target)) view.select(target);
    const held = target.kind === "point" ? findRecord(project, "point", target.id)?.position : undefined;
    const start = held ?? hit.position;
    const { ray } = viewer.seenFrom(pointer.at);
    const sight = unit(ray.direction) ?? ray.direction;
    const isFlat = Math.abs(dot(sight, this.#frame.z)) < flattest;
    const plane = { ...this.#frame, origin: start, ...(isFlat && { z: sight }) };
    motion.start({ mode: "translate", selection: moved, base: start, axis: null, isHeld: true });
    const isPoint = held !== undefined;
    const targets = isPoint ? targetsBeside(project, moved) : null;
    return { start, plane, targets };
  }

  #offsetAt(pointer: ToolPointer, { start, plane, targets }: Drag): Position | null {
    const { view, viewer, motion } = this.#stores;
    const { snapping } = view.state.getState();
    const seen = viewer.seenFrom(pointer.at);
    const step = snapping.grid && !pointer.mod ? this.#step : 0;
    const steppedFrom = (to: number, from: number): number =>
      targets ? stepped(to, from, step) : stepped(to - from, 0, step);
    if (motion.axis !== null) {
      const at = onLine(seen.ray, start, axisDirections[motion.axis]);
      return at && (at.map((x, k) => steppedFrom(x, start[k] ?? 0)) as [number, number, number]);
    }
    const snap = targets && snapping.model && !pointer.mod ? snapToModel(targets, seen) : null;
    if (snap) return subtract(snap.position, start);
    const at = onPlane(seen.ray, plane);
    if (!at) return null;
    const to = toFrame(this.#frame, at);
    const from = toFrame(this.#frame, start);
    const noise = roundingShare * Math.max(...[...to, ...from].map(Math.abs));
    const offset = to.map((x, k) => {
      const moved = steppedFrom(x, from[k] ?? 0);
      return Math.abs(moved) <= noise ? 0 : moved;
    }) as [number, number, number];
    return fromFrame({ ...this.#frame, origin: zero }, pointer.shift ? alongOneAxis(offset) : offset);
  }
}

/** Returns how far a coordinate moves: to a multiple of the step, unless it stays within half a step. */
function stepped(to: number, from: number, step: number): number {
  if (step === 0) return to - from;
  return Math.abs(to - from) < step / 2 ? 0 : roundTo(to, step) - from;
}

/** Returns the offset without its smaller parts. */
function alongOneAxis(offset: Position): Position {
  const largest = Math.max(...offset.map(Math.abs));
  return offset.map((x) => (Math.abs(x) === largest ? x : 0)) as [number, number, number];
}

/** Returns the points and lines that do not move with a selection. */
function targetsBeside(project: Project, selection: readonly Entity[]): SnapTargets {
  const moved = new Set(selectedParts(project, selection).points.map(({ id }) => id));
  const stays = (id: number): boolean => !moved.has(id);
  return {
    points: project.points.filter(({ id }) => stays(id)),
    lines: linePaths(project, null).filter(({ line }) => line.points.every(stays)),
  };
}

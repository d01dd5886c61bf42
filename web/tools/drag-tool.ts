import type { Project } from "tetrafront/project";
import { bodyOfPatch, findRecord, sameEntity, type Entity } from "../document/entities";
import { linePaths } from "../document/line-paths";
import type { Position } from "../document/position";
import type { ViewStore } from "../document/selection";
import { translation } from "../document/transforms/affine";
import { selectedParts } from "../document/transforms/selected-parts";
import { offerTransform, transformStep } from "../document/transforms/transform";
import {
  axisDirections,
  dot,
  fromFrame,
  scale,
  subtract,
  toFrame,
  unit,
  zero,
  type Frame,
} from "../document/vectors";
import { onLine, onPlane, roundStep, roundTo } from "../document/work-plane";
import type { DocumentStore } from "../session/document-store";
import { strings } from "../strings";
import { formatPosition } from "../ui/format";
import type { Hit, Layer } from "../viewer/layers/layer";
import type { Viewer } from "../viewer/viewer";
import { snapToModel, type SnapTargets } from "./drawing/snapping";
import type { Motion } from "./motion";
import type { Tool, ToolPointer } from "./tool";

export interface DragStores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly motion: Motion;
  readonly viewer: Pick<Viewer, "seenFrom" | "pixelLength">;
}

/** Smallest step of a drag and of an arrow key, in CSS pixels. */
const stepPixels = 10;
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

/** Moves per arrow key, in the axes of the work plane. */
const directions: Readonly<Record<string, Position>> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowDown: [0, -1, 0],
  ArrowUp: [0, 1, 0],
  PageDown: [0, 0, -1],
  PageUp: [0, 0, 1],
};

/** What a drag takes: whatever lies under the pointer, or only points that are selected or belong to a selected line. */
export type Draggable = "all" | "held-points";

/**
 * Drags the selection in the work plane, or parallel to the view if that plane is seen from its edge; a press on anything
 * else selects it first. With `held-points`, only selected points and the points of selected lines are dragged, and all else
 * is left to the other tool. Shift keeps to one axis, Ctrl turns snapping off. Numbers may be typed. What coincides after the drag is joined. Arrow
 * keys move by a step of the grid.
 */
export class DragTool implements Tool {
  readonly id: string;
  readonly #stores: DragStores;
  /** Receives the presses beside the model. */
  readonly #otherwise: Tool;
  readonly #draggable: Draggable;
  #drag: Drag | null = null;

  constructor(stores: DragStores, otherwise: Tool, draggable: Draggable = "all") {
    this.id = draggable === "all" ? "move" : otherwise.id;
    this.#stores = stores;
    this.#otherwise = otherwise;
    this.#draggable = draggable;
  }

  down(pointer: ToolPointer): boolean {
    this.#drag = pointer.button === "left" && !pointer.mod && !pointer.shift ? this.#begin(pointer) : null;
    return this.#drag !== null || this.#otherwise.down(this.#passed(pointer));
  }

  move(pointer: ToolPointer | null): void {
    if (!pointer || !this.#drag) return this.#otherwise.move(pointer);
    if (!pointer.isDrag) return;
    const offset = this.#offsetAt(pointer, this.#drag);
    if (!offset) return;
    const amount = strings.drawing.amounts.translate(formatPosition(offset));
    this.#stores.motion.drag(translation(offset), amount, pointer.at);
  }

  up(pointer: ToolPointer): void {
    const { motion } = this.#stores;
    const drag = this.#drag;
    this.#drag = null;
    // Enter may have ended the motion before.
    if (drag && (pointer.isDrag || motion.isTyping || !motion.isRunning)) return motion.release();
    if (drag) motion.cancel();
    this.#otherwise.up(this.#passed(pointer));
  }

  cancel(): void {
    if (this.#drag) this.#stores.motion.cancel();
    this.#drag = null;
    this.#otherwise.cancel();
  }

  key(event: KeyboardEvent): boolean {
    const { motion } = this.#stores;
    if (motion.isRunning && motion.key(event, () => null)) return true;
    if (this.#draggable !== "all") return this.#otherwise.key(event);
    if (event.key === "Escape") {
      this.#stores.view.setTool("select");
      return true;
    }
    const direction = event.ctrlKey || event.metaKey ? undefined : directions[event.key];
    return direction !== undefined && this.#nudge(direction, event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
  }

  overlay(): Layer | null {
    return this.#draggable === "all" ? null : this.#otherwise.overlay();
  }

  /** Returns the pointer for the other tool: where all can be dragged, a body is taken in place of its patch. */
  #passed(pointer: ToolPointer): ToolPointer {
    if (this.#draggable !== "all") return pointer;
    const { project } = this.#stores.documents;
    const hit = (): Hit | null => {
      const found = pointer.hit();
      if (found?.target.kind !== "body-patch") return found;
      return { ...found, target: movedBy(project, found.target) };
    };
    return { ...pointer, hit };
  }

  get #step(): number {
    return roundStep(stepPixels * this.#stores.viewer.pixelLength);
  }

  get #frame(): Frame {
    return this.#stores.view.state.getState().workPlane.frame;
  }

  /** Returns an offset that is given in the axes of the work plane. */
  #fromPlane(offset: Position): Position {
    return fromFrame({ ...this.#frame, origin: zero }, offset);
  }

  /** Returns false if nothing is selected: the keys then move the camera. */
  #nudge(direction: Position, steps: number): boolean {
    const { documents, view } = this.#stores;
    const map = translation(this.#fromPlane(scale(direction, steps * this.#step)));
    const { selection } = view.state.getState();
    const offer = offerTransform(documents.project, selection, map, {
      label: transformStep("move", selection),
      join: false,
    });
    if (offer.possible) documents.edit({ ...offer.creation.edit, mergeKey: "nudge" });
    return offer.possible;
  }

  #begin(pointer: ToolPointer): Drag | null {
    const { documents, viewer, motion } = this.#stores;
    // A press must not end the preview of an operation.
    if (documents.state.getState().gestureStart !== null) return null;
    const hit = pointer.hit();
    if (!hit || hit.target.kind === "element") return null;
    const { project } = documents;
    const target = movedBy(project, hit.target);
    const moved = this.#movedWith(project, target);
    const none = { label: "", join: false };
    if (!moved || !offerTransform(project, moved, translation(zero), none).possible) return null;
    const selection = this.#draggable === "all" ? this.#selected(target) : moved;
    const held = target.kind === "point" ? findRecord(project, "point", target.id)?.position : undefined;
    const start = held ?? hit.position;
    const { ray } = viewer.seenFrom(pointer.at);
    const sight = unit(ray.direction) ?? ray.direction;
    const isFlat = Math.abs(dot(sight, this.#frame.z)) < flattest;
    const plane = { ...this.#frame, origin: start, ...(isFlat && { z: sight }) };
    motion.start({ mode: "translate", selection, base: start, axis: null, isHeld: true });
    const isPoint = held !== undefined;
    const targets = isPoint ? targetsBeside(project, selection) : null;
    return { start, plane, targets };
  }

  /** Returns what a drag of an entity moves; null if it moves nothing. */
  #movedWith(project: Project, target: Entity): readonly Entity[] | null {
    const { view } = this.#stores;
    const { selection, several } = view.state.getState();
    const isSelected = selection.some((entity) => sameEntity(entity, target));
    if (this.#draggable === "held-points") {
      if (target.kind !== "point" || several) return null;
      if (isSelected) return selection;
      const isOfLine = selection.some(
        ({ kind, id }) => kind === "line" && findRecord(project, "line", id)?.points.includes(target.id),
      );
      return isOfLine ? [target] : null;
    }
    return isSelected ? selection : [target];
  }

  /** Selects an entity that is not selected. Returns the selection. */
  #selected(target: Entity): readonly Entity[] {
    const { view } = this.#stores;
    if (!view.state.getState().selection.some((entity) => sameEntity(entity, target))) view.select(target);
    return view.state.getState().selection;
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
    return this.#fromPlane(pointer.shift ? alongOneAxis(offset) : offset);
  }
}

/** Returns what a drag of an entity moves: a patch of a body moves with its body. */
function movedBy(project: Project, entity: Entity): Entity {
  const body = entity.kind === "body-patch" ? bodyOfPatch(project, entity.id) : undefined;
  return body ? { kind: "body", id: body.id } : entity;
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

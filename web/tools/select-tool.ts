import { sameEntity, type Entity } from "../document/entities";
import { linePaths } from "../document/line-paths";
import type { SelectMode, ViewStore } from "../document/selection";
import type { DocumentStore } from "../session/document-store";
import type { PreviewFeed } from "../session/preview";
import type { Target } from "../viewer/layers/layer";
import type { ScreenPoint } from "../viewer/screen";
import type { ShownBody } from "../viewer/shown-bodies";
import type { Viewer } from "../viewer/viewer";
import type { Drawing } from "./drawing/drawing";
import type { Interaction, ToolPointer } from "./interaction";
import { entitiesWithin, outlinedBodies, outlineOf, shownEntities } from "./outline-selection";

/** What selecting asks of the view. */
export interface SelectViewer extends Pick<Viewer, "seenFrom" | "entitiesAt"> {
  readonly framing: Pick<Viewer["framing"], "fitTarget">;
}

export interface SelectStores {
  readonly documents: Pick<DocumentStore, "project">;
  readonly previews: Pick<PreviewFeed, "state">;
  readonly view: ViewStore;
  readonly drawing: Pick<Drawing, "state">;
  /** Returns the bodies of the project. */
  readonly bodies: () => readonly ShownBody[];
  /** Returns what a click on an entity means; without it, the entity itself. */
  readonly meant?: (entity: Entity) => Entity;
}

/** An entity under the pointer. */
export interface Hover {
  readonly entity: Entity;
  readonly at: ScreenPoint;
}

export interface SelectEvents {
  /** An entity has come under the resting pointer, or none. */
  readonly onHover: (hover: Hover | null) => void;
  /** The selected entity was clicked twice. */
  readonly onEdit: () => void;
}

/** A click that Tab can repeat on what lies underneath. */
interface Click {
  readonly at: ScreenPoint;
  readonly mode: SelectMode;
  /** The entity that it selected; null for none. */
  readonly entity: Entity | null;
  /** The selection before the click and after it. */
  readonly before: readonly Entity[];
  readonly after: readonly Entity[];
}

/** Time that the pointer must rest before the entity under it is highlighted, in milliseconds. */
const hoverDelay = 80;

/**
 * A click selects. A double click edits an entity; by a finger, or on anything else, it fits the view. A drag selects what
 * lies within a box or, with Alt, a lasso. A resting pointer highlights the entity under it. After a click, Tab goes through
 * all that lies under the pointer: the click then means the next entity, and what else is selected stays.
 */
export class SelectTool implements Interaction {
  readonly #viewer: SelectViewer;
  readonly #stores: SelectStores;
  readonly #events: SelectEvents;
  /** The corners of a lasso, or the two of a box; null without a press. */
  #outline: readonly ScreenPoint[] | null = null;
  #restTimer: ReturnType<typeof setTimeout> | undefined;
  /** The last click, while the pointer has not left it. */
  #clicked: Click | null = null;

  constructor(viewer: SelectViewer, stores: SelectStores, events: SelectEvents) {
    this.#viewer = viewer;
    this.#stores = stores;
    this.#events = events;
  }

  /** A drag with the left button draws a box. With Shift it pans. */
  down(pointer: ToolPointer): boolean {
    clearTimeout(this.#restTimer);
    const isSelecting = this.#view.state.getState().leftDrag === "select";
    const isClaimed = pointer.button === "left" && !pointer.touch && !pointer.shift && isSelecting;
    if (isClaimed) this.#outline = [pointer.at];
    return isClaimed;
  }

  move(pointer: ToolPointer | null): boolean {
    clearTimeout(this.#restTimer);
    if (!pointer || (this.#clicked && isFar(pointer.at, this.#clicked.at))) this.#clicked = null;
    if (pointer && this.#outline) {
      if (pointer.isDrag) this.#draw(pointer, this.#outline);
    } else if (pointer) this.#restTimer = setTimeout(() => this.#rest(pointer), hoverDelay);
    else this.#setHover(null);
    return pointer !== null;
  }

  up(pointer: ToolPointer): boolean {
    const outline = this.#outline;
    this.cancel();
    if (pointer.button === "right") this.#openMenu(pointer);
    if (pointer.button !== "left") return true;
    if (pointer.isDrag && outline) this.#selectWithin(outline, pointer);
    else this.#selectAt(pointer);
    return true;
  }

  cancel(): void {
    clearTimeout(this.#restTimer);
    this.#outline = null;
    if (this.#stores.drawing.state.getState().outline) this.#stores.drawing.state.setState({ outline: null });
  }

  /** Tab moves the focus unless something was clicked that hides other entities. */
  key(event: KeyboardEvent): boolean {
    if (event.key !== "Tab" || event.ctrlKey || event.altKey || event.metaKey) return false;
    return this.#clicked !== null && this.#selectNext(this.#clicked, event.shiftKey ? -1 : 1);
  }

  get #view(): ViewStore {
    return this.#stores.view;
  }

  #selectAt(pointer: ToolPointer): void {
    const { selection: before } = this.#view.state.getState();
    const target = this.#targetAt(pointer);
    // With a key, each click adds or toggles, however fast they follow each other.
    if (pointer.clicks === 2 && modeOf(pointer) === "replace") this.#doubleClick(pointer, target);
    else if (target?.kind === "element") this.#view.selectElement(target.index);
    else this.#view.select(target, modeOf(pointer));
    const entity = target?.kind === "element" ? null : target;
    this.#clicked = this.#click(pointer.at, modeOf(pointer), entity, before);
  }

  #targetAt(pointer: ToolPointer): Target | null {
    const target = pointer.hit()?.target ?? null;
    return target && target.kind !== "element" ? (this.#stores.meant?.(target) ?? target) : target;
  }

  #doubleClick(pointer: ToolPointer, target: Target | null): void {
    const isEdited = target && target.kind !== "element" && !pointer.touch;
    if (!isEdited) return this.#viewer.framing.fitTarget(target);
    this.#view.select(target);
    this.#events.onEdit();
  }

  #click(at: ScreenPoint, mode: SelectMode, entity: Entity | null, before: readonly Entity[]): Click {
    return { at, mode, entity, before, after: this.#view.state.getState().selection };
  }

  /** Repeats a click on what follows its entity under the pointer. Returns false if there is nothing else. */
  #selectNext({ at, mode, entity, before, after }: Click, step: 1 | -1): boolean {
    if (this.#view.state.getState().selection !== after) return false;
    const found = this.#viewer.entitiesAt(at);
    const index = found.findIndex((other) => sameEntity(other, entity));
    const next = found.at(index < 0 ? 0 : (index + step) % found.length);
    if (!next || sameEntity(next, entity)) return false;
    this.#view.selectAll(before);
    this.#view.select(next, mode);
    this.#clicked = this.#click(at, mode, next, before);
    return true;
  }

  #draw(pointer: ToolPointer, outline: readonly ScreenPoint[]): void {
    const [start = pointer.at] = outline;
    this.#outline = pointer.alt ? [...outline, pointer.at] : [start, pointer.at];
    this.#stores.drawing.state.setState({ outline: outlineOf(this.#outline) });
  }

  #selectWithin(corners: readonly ScreenPoint[], pointer: ToolPointer): void {
    const { documents, previews, view, bodies } = this.#stores;
    const { preview, project: sampled } = previews.state.getState();
    const { project } = documents;
    const paths = linePaths(project, preview && sampled && { samples: preview, project: sampled });
    const state = view.state.getState();
    const shown = [...shownEntities(project, paths, state), ...outlinedBodies(bodies(), state)];
    const { toScreen } = this.#viewer.seenFrom(pointer.at);
    view.selectMany(entitiesWithin(outlineOf(corners), shown, toScreen), pointer.mod ? "toggle" : "replace");
  }

  /** The menu is about the entity under the pointer, and the selection if the entity belongs to it. */
  #openMenu(pointer: ToolPointer): void {
    const target = this.#targetAt(pointer);
    const { selection } = this.#view.state.getState();
    const isSelected = target?.kind !== "element" && selection.some((entity) => sameEntity(entity, target));
    if (target && target.kind !== "element" && !isSelected) this.#view.select(target);
    this.#stores.drawing.state.setState({ menu: pointer.at, menuPosition: pointer.hit()?.position ?? null });
  }

  #rest(pointer: ToolPointer): void {
    const target = this.#targetAt(pointer);
    this.#setHover(target && target.kind !== "element" ? { entity: target, at: pointer.at } : null);
  }

  #setHover(hover: Hover | null): void {
    this.#view.setHover(hover?.entity ?? null);
    this.#events.onHover(hover);
  }
}

/** Has the pointer moved since a click? In CSS pixels. */
const stillness = 6;
const isFar = (a: ScreenPoint, b: ScreenPoint): boolean => Math.hypot(a.x - b.x, a.y - b.y) > stillness;

function modeOf({ mod, shift }: ToolPointer): SelectMode {
  if (mod) return "toggle";
  return shift ? "add" : "replace";
}

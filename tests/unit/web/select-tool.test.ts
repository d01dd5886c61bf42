import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { createStore } from "zustand/vanilla";
import type { Entity } from "../../../web/document/entities";
import { ViewStore } from "../../../web/document/selection";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { SelectTool, type Hover, type SelectStores } from "../../../web/tools/select-tool";
import type { ToolPointer } from "../../../web/tools/interaction";
import type { Target } from "../../../web/viewer/layers/layer";
import type { Viewer } from "../../../web/viewer/viewer";
import { drawnSurface } from "../../../web/document/drawn-surface";
import type { ShownBody } from "../../../web/viewer/shown-bodies";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";

const line = (id: number): Target => ({ kind: "line", id });
let view: ViewStore;
let drawing: Drawing;
let tool: SelectTool;
let fitted: (Target | null)[];
let hovers: (Hover | null)[];
let bodies: readonly ShownBody[];
let meant: (entity: Entity) => Entity;
/** Ids of what was to be edited. */
let edited: number[];
/** What lies under the pointer. */
let under: Entity[];

beforeEach(() => {
  vi.useFakeTimers();
  view = new ViewStore();
  fitted = [];
  hovers = [];
  edited = [];
  under = [];
  drawing = new Drawing();
  bodies = [];
  meant = (entity) => entity;
  const project = cubeProject();
  const previews = { state: createStore(() => ({ preview: null, project: null })) };
  tool = new SelectTool(
    {
      framing: { fitTarget: (target) => void fitted.push(target) },
      seenFrom: fromAbove,
      entitiesAt: () => under,
    },
    {
      documents: { project },
      previews: previews as unknown as SelectStores["previews"],
      view,
      drawing,
      bodies: () => bodies,
      meant: (entity) => meant(entity),
    },
    { onHover: (hover) => hovers.push(hover), onEdit: () => edited.push(...selected()) },
  );
});
afterEach(() => vi.useRealTimers());

/** A view of the unit cube from above, without perspective: 100 pixels per unit. */
const fromAbove: Viewer["seenFrom"] = (at) => ({
  pointer: at,
  ray: { origin: [at.x / 100, at.y / 100, 10], direction: [0, 0, -1] },
  toScreen: ([x, y]) => ({ x: 100 * x, y: 100 * y }),
});

function pointer(target: Target | null, change: Partial<ToolPointer> = {}): ToolPointer {
  const hit = target && { target, position: [0, 0, 0] as const, depth: 1 };
  const modifiers = { shift: false, mod: false, alt: false };
  return {
    at: { x: 5, y: 6 },
    button: "left",
    ...modifiers,
    touch: false,
    isDrag: false,
    clicks: 1,
    hit: () => hit,
    ...change,
  };
}

const selected = (): readonly number[] => view.state.getState().selection.map(({ id }) => id);

it("a press of the left button draws a box; with Shift, by a finger or if the left button orbits, it moves the camera", () => {
  expect(tool.down(pointer(null))).toBe(true);
  expect(tool.down(pointer(null, { shift: true }))).toBe(false);
  expect(tool.down(pointer(null, { touch: true }))).toBe(false);
  expect(tool.down(pointer(null, { button: "right" }))).toBe(false);
  view.state.setState({ leftDrag: "orbit" });
  expect(tool.down(pointer(null))).toBe(false);
});

function drag(...corners: readonly (readonly [x: number, y: number])[]): void {
  const path = corners.map(([x, y]) =>
    pointer(null, { at: { x, y }, isDrag: true, alt: corners.length > 2 }),
  );
  const [start = pointer(null), ...rest] = path;
  tool.down(start);
  for (const next of rest) tool.move(next);
  tool.up(rest.at(-1) ?? start);
}

const kinds = (): Record<string, number> =>
  view.state
    .getState()
    .selection.reduce<Record<string, number>>(
      (counts, { kind }) => ({ ...counts, [kind]: (counts[kind] ?? 0) + 1 }),
      {},
    );

it("a box drawn to the right selects what lies inside, one drawn to the left what it touches", () => {
  drag([-10, -10], [110, 110]);
  expect(kinds()).toEqual({ point: 8, line: 12, patch: 6 });
  // Around the edge at x = 0, y = 0 of the cube, seen along it: two points and the line between them lie inside.
  drag([-10, -10], [10, 10]);
  expect(kinds()).toEqual({ point: 2, line: 1 });
  drag([10, 10], [-10, -10]);
  expect(kinds()).toEqual({ point: 2, line: 5, patch: 4 });
  drag([200, 200], [210, 210]);
  expect(kinds()).toEqual({});
});

it("a box selects bodies by all their triangles, where they are placed, unless they are hidden", () => {
  const shown = (id: number, x: number): ShownBody => {
    const { points, triangles } = boxSurface(2, [0, 0, 0], [1, 1, 1]);
    const trianglePatch = new Uint32Array(triangles.length / 3);
    const drawn = drawnSurface({ points, triangles, trianglePatch }, 1);
    const placement = { position: [x, 5, 0] as const, scale: 2 };
    const none = { preview: null, split: null, patches: [] };
    return { id, placement, given: { drawn } as unknown as ShownBody["given"], ...none };
  };
  bodies = [shown(1, 5), shown(2, 8)];
  drag([490, 490], [710, 710]);
  expect(kinds()).toEqual({ body: 1 });
  expect(selected()).toEqual([1]);
  // Without a node in the box.
  drag([690, 600], [640, 610]);
  expect(selected()).toEqual([1]);
  drag([810, 600], [690, 610]);
  expect(selected()).toEqual([1, 2]);
  view.state.setState({ hidden: new Set(["body-2"]) });
  drag([490, 490], [1010, 710]);
  expect(selected()).toEqual([1]);
  view.setLayer("bodies", false);
  drag([490, 490], [1010, 710]);
  expect(selected()).toEqual([]);
});

it("a clockwise lasso selects what lies inside, a counter-clockwise one what it touches, wherever they end", () => {
  const inside = { point: 6, line: 7, patch: 2 };
  for (const end of [
    [-9, -5],
    [-11, -5],
  ] as const) {
    // prettier-ignore
    drag([-10, -10], [120, -10], [-10, 120], end);
    expect(kinds()).toEqual(inside);
  }
  for (const end of [
    [-5, -9],
    [-15, -9],
  ] as const) {
    // prettier-ignore
    drag([-10, -10], [-10, 120], [120, -10], end);
    expect(kinds()["line"]).toBeGreaterThan(inside.line);
  }
});

it("a click selects an entity; with Shift it adds, with Ctrl it toggles, and on nothing it clears the selection", () => {
  tool.up(pointer(line(1)));
  tool.up(pointer(line(2), { shift: true }));
  tool.up(pointer(line(3), { mod: true }));
  expect(selected()).toEqual([1, 2, 3]);
  tool.up(pointer(line(2), { mod: true }));
  expect(selected()).toEqual([1, 3]);
  tool.up(pointer(line(7)));
  expect(selected()).toEqual([7]);
  tool.up(pointer(null, { shift: true }));
  expect(selected()).toEqual([7]);
  tool.up(pointer(null));
  expect(selected()).toEqual([]);
});

it("a click selects a tetrahedron", () => {
  tool.up(pointer({ kind: "element", index: 42 }));
  expect(view.state.getState().element).toBe(42);
});

it("the right button opens a menu for what is under the pointer, or for the selection that it belongs to", () => {
  tool.up(pointer(line(1), { button: "middle" }));
  expect(selected()).toEqual([]);
  tool.up(pointer(line(1), { button: "right" }));
  expect(selected()).toEqual([1]);
  expect(drawing.state.getState().menu).toEqual({ x: 5, y: 6 });
  view.selectAll([{ kind: "line", id: 2 }, { kind: "line", id: 3 }]); // prettier-ignore
  tool.up(pointer(line(3), { button: "right" }));
  expect(selected()).toEqual([2, 3]);
});

it("a double click edits the entity; by a finger it fits the view to it, beside all entities to the model", () => {
  tool.up(pointer(line(1)));
  tool.up(pointer(line(1), { clicks: 2 }));
  expect(edited).toEqual([1]);
  expect(fitted).toEqual([]);
  tool.up(pointer(line(1), { clicks: 2, touch: true }));
  tool.up(pointer(null, { clicks: 2 }));
  expect(fitted).toEqual([line(1), null]);
  expect(selected()).toEqual([1]);
  expect(edited).toEqual([1]);
});

it("fast clicks with Ctrl or Shift toggle or add, each of them", () => {
  view.selectAll([1, 2, 3].map((id) => ({ kind: "line", id })));
  tool.up(pointer(line(2), { mod: true }));
  expect(selected()).toEqual([1, 3]);
  tool.up(pointer(line(2), { mod: true, clicks: 2 }));
  expect(selected()).toEqual([1, 3, 2]);
  tool.up(pointer(line(4), { shift: true, clicks: 2 }));
  expect(selected()).toEqual([1, 3, 2, 4]);
  expect([edited, fitted]).toEqual([[], []]);
});

it("the entity under a resting pointer is highlighted; a moving pointer causes no hit test", () => {
  const hit = vi.fn(() => ({ target: line(4), position: [0, 0, 0] as const, depth: 1 }));
  for (let move = 0; move < 10; ++move) {
    tool.move(pointer(null, { hit }));
    vi.advanceTimersByTime(20);
  }
  expect(hit).not.toHaveBeenCalled();
  vi.advanceTimersByTime(80);
  expect(hit).toHaveBeenCalledTimes(1);
  expect(view.state.getState().hover).toEqual(line(4));
  expect(hovers).toEqual([{ entity: line(4), at: { x: 5, y: 6 } }]);
});

it("nothing is highlighted over a tetrahedron, after a press, or after the pointer has left", () => {
  tool.move(pointer({ kind: "element", index: 1 }));
  vi.advanceTimersByTime(100);
  expect(view.state.getState().hover).toBeNull();
  tool.move(pointer(line(4)));
  tool.down(pointer(null));
  vi.advanceTimersByTime(100);
  expect(view.state.getState().hover).toBeNull();
  tool.move(pointer(line(4)));
  vi.advanceTimersByTime(100);
  tool.move(null);
  expect(view.state.getState().hover).toBeNull();
  expect(hovers.at(-1)).toBeNull();
});

const tab = (shiftKey = false): boolean =>
  tool.key({ key: "Tab", shiftKey, ctrlKey: false, altKey: false, metaKey: false } as KeyboardEvent);

it("Tab goes through all that lies under the pointer after a click, and else moves the focus", () => {
  under = [1, 2, 3].map((id) => ({ kind: "line", id }));
  expect(tab()).toBe(false);
  tool.up(pointer(line(1)));
  expect([tab(), selected()]).toEqual([true, [2]]);
  expect([tab(), selected()]).toEqual([true, [3]]);
  expect([tab(), selected()]).toEqual([true, [1]]);
  expect([tab(true), selected()]).toEqual([true, [3]]);
  // A pointer that has left the place gives the key back.
  tool.move(pointer(null, { at: { x: 50, y: 6 }, button: null }));
  expect(tab()).toBe(false);
  under = [{ kind: "line", id: 1 }];
  tool.up(pointer(line(1)));
  expect(tab()).toBe(false);
});

it("after a click with Ctrl or Shift, Tab exchanges the entity last clicked and keeps the rest of the selection", () => {
  under = [1, 2, 3].map((id) => ({ kind: "line", id }));
  tool.up(pointer(line(7)));
  tool.up(pointer(line(8), { mod: true }));
  tool.up(pointer(line(1), { mod: true }));
  expect(selected()).toEqual([7, 8, 1]);
  expect([tab(), selected()]).toEqual([true, [7, 8, 2]]);
  expect([tab(), selected()]).toEqual([true, [7, 8, 3]]);
  expect([tab(true), selected()]).toEqual([true, [7, 8, 2]]);
  tool.up(pointer(line(1), { shift: true }));
  expect([tab(true), selected()]).toEqual([true, [7, 8, 2, 3]]);
  // A click that removed the uppermost entity removes the next one instead.
  view.selectAll([1, 2, 3].map(line) as Entity[]);
  tool.up(pointer(line(1), { mod: true }));
  expect([tab(), selected()]).toEqual([true, [1, 3]]);
});

it("Tab moves the focus if the selection has changed since the click", () => {
  under = [1, 2].map((id) => ({ kind: "line", id }));
  tool.up(pointer(line(1), { mod: true }));
  view.selectAll([1, 2, 3].map(line) as Entity[]);
  expect([tab(), selected()]).toEqual([false, [1, 2, 3]]);
});

it("hovers, selects and opens the menu of the entity that is meant by the one under the pointer", () => {
  meant = ({ kind, id }) => (kind === "body-patch" ? { kind: "body", id: 7 } : { kind, id });
  const patch: Target = { kind: "body-patch", id: 70 };
  tool.move(pointer(patch, { button: null }));
  vi.runAllTimers();
  expect(hovers.at(-1)?.entity).toEqual({ kind: "body", id: 7 });
  for (const button of ["left", "right"] as const) {
    view.select(null);
    expect(tool.up(pointer(patch, { button }))).toBe(true);
    expect(view.state.getState().selection).toEqual([{ kind: "body", id: 7 }]);
  }
  tool.up(pointer(line(10)));
  expect(view.state.getState().selection).toEqual([line(10)]);
});

import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { ViewStore } from "../../../web/document/selection";
import { SelectTool, type Hover } from "../../../web/tools/select-tool";
import type { ToolPointer } from "../../../web/tools/tool";
import type { Target } from "../../../web/viewer/layers/layer";

const line = (id: number): Target => ({ kind: "line", id });
let view: ViewStore;
let tool: SelectTool;
let fitted: (Target | null)[];
let hovers: (Hover | null)[];

beforeEach(() => {
  vi.useFakeTimers();
  view = new ViewStore();
  fitted = [];
  hovers = [];
  tool = new SelectTool({ fitTarget: (target) => void fitted.push(target) }, view, (hover) =>
    hovers.push(hover),
  );
});
afterEach(() => vi.useRealTimers());

function pointer(target: Target | null, change: Partial<ToolPointer> = {}): ToolPointer {
  const hit = target && { target, position: [0, 0, 0] as const, depth: 1 };
  const modifiers = { shift: false, mod: false, alt: false };
  return {
    at: { x: 5, y: 6 },
    button: "left",
    ...modifiers,
    isDrag: false,
    clicks: 1,
    hit: () => hit,
    ...change,
  };
}

const selected = (): readonly number[] => view.state.getState().selection.map(({ id }) => id);

it("the select tool leaves every press to the camera", () => {
  expect(tool.down()).toBe(false);
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

it("the select tool ignores other buttons", () => {
  tool.up(pointer(line(1), { button: "right" }));
  tool.up(pointer(line(1), { button: "middle" }));
  expect(selected()).toEqual([]);
});

it("a double click fits the view to the entity, or to the model if there is none", () => {
  tool.up(pointer(line(1)));
  tool.up(pointer(line(1), { clicks: 2 }));
  tool.up(pointer(null, { clicks: 2 }));
  expect(fitted).toEqual([line(1), null]);
  expect(selected()).toEqual([1]);
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
  tool.down();
  vi.advanceTimersByTime(100);
  expect(view.state.getState().hover).toBeNull();
  tool.move(pointer(line(4)));
  vi.advanceTimersByTime(100);
  tool.move(null);
  expect(view.state.getState().hover).toBeNull();
  expect(hovers.at(-1)).toBeNull();
});

import { beforeEach, expect, it } from "vitest";
import { moveEntity } from "../../../web/document/edits";
import { ViewStore } from "../../../web/document/selection";
import { DocumentStore } from "../../../web/session/document-store";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { DragTool } from "../../../web/tools/drag-tool";
import type { Tool, ToolPointer } from "../../../web/tools/tool";
import type { Target } from "../../../web/viewer/layers/layer";
import type { Viewer } from "../../../web/viewer/viewer";
import { cubeProject } from "../../support/projects";

let documents: DocumentStore;
let view: ViewStore;
let tool: DragTool;
let passed: string[];
let other: Tool;

beforeEach(() => {
  documents = new DocumentStore(cubeProject());
  view = new ViewStore();
  passed = [];
  other = {
    id: "other",
    down: () => (passed.push("down"), false),
    move: () => void passed.push("move"),
    up: () => void passed.push("up"),
    cancel: () => void passed.push("cancel"),
    key: () => false,
    overlay: () => null,
  };
  tool = new DragTool(
    { documents, view, drawing: new Drawing(), viewer: { seenFrom: fromAbove, pixelLength: 0.01 } },
    other,
  );
});

/** A view of the unit cube from above, without perspective: 100 pixels per unit. */
const fromAbove: Viewer["seenFrom"] = (at) => ({
  pointer: at,
  ray: { origin: [at.x / 100, at.y / 100, 10], direction: [0, 0, -1] },
  toScreen: ([x, y]) => ({ x: 100 * x, y: 100 * y }),
});

/** The pointer at a place of the plane z = 0, on a target. */
function pointer(
  x: number,
  y: number,
  target: Target | null,
  change: Partial<ToolPointer> = {},
): ToolPointer {
  return {
    at: { x: 100 * x, y: 100 * y },
    button: "left",
    shift: false,
    mod: false,
    alt: false,
    touch: false,
    isDrag: true,
    clicks: 1,
    hit: () => target && { target, position: [x, y, 0], depth: 1 },
    ...change,
  };
}

const first = (): { readonly id: number; readonly position: readonly number[] } => {
  const [point] = documents.project.points;
  if (!point) throw new Error("the cube has no points");
  return point;
};
const past = (): number => documents.state.getState().history.past.length;

function drag(target: Target, to: readonly [number, number], change: Partial<ToolPointer> = {}): void {
  const [x = 0, y = 0] = first().position;
  expect(tool.down(pointer(x, y, target))).toBe(true);
  tool.move(pointer(to[0], to[1], null, change));
  tool.up(pointer(to[0], to[1], null, change));
}

it("drags a point to the grid, as one step of undo", () => {
  const { id, position } = first();
  const [x = 0, y = 0, z = 0] = position;
  drag({ kind: "point", id }, [x + 0.312, y - 0.188]);
  expect(first().position).toEqual([x + 0.3, y - 0.2, z]);
  expect(view.state.getState().selection).toEqual([{ kind: "point", id }]);
  expect(past()).toBe(1);
  documents.undo();
  expect(first().position).toEqual(position);
});

it("keeps to one axis with Shift, and moves freely with Ctrl", () => {
  const { id, position } = first();
  const [x = 0, y = 0] = position;
  drag({ kind: "point", id }, [x + 0.312, y - 0.1], { shift: true });
  expect(first().position[1]).toBe(y);
  documents.undo();
  drag({ kind: "point", id }, [x + 0.312, y - 0.188], { mod: true });
  expect(first().position[0]).toBeCloseTo(x + 0.312, 12);
});

it("restores everything when a drag is cancelled, and changes nothing by a click", () => {
  const { id, position } = first();
  tool.down(pointer(position[0] ?? 0, position[1] ?? 0, { kind: "point", id }));
  tool.move(pointer(5, 5, null));
  expect(first().position).not.toEqual(position);
  tool.cancel();
  expect(first().position).toEqual(position);
  drag({ kind: "point", id }, [5, 5], { isDrag: false });
  expect(first().position).toEqual(position);
  expect(past()).toBe(0);
  expect(passed).toEqual(["cancel", "up"]);
});

it("leaves presses beside the model, and with Ctrl or Shift, to the other tool", () => {
  const target: Target = { kind: "point", id: first().id };
  expect(tool.down(pointer(0, 0, null))).toBe(false);
  expect(tool.down(pointer(0, 0, target, { mod: true }))).toBe(false);
  expect(tool.down(pointer(0, 0, target, { shift: true }))).toBe(false);
  expect(passed).toEqual(["down", "down", "down"]);
});

it("moves the selection by arrow keys, ten steps with Shift; without a selection the camera gets the keys", () => {
  const { id, position } = first();
  const key = (name: string, shiftKey = false): boolean =>
    tool.key({ key: name, shiftKey, altKey: false, ctrlKey: false, metaKey: false } as KeyboardEvent);
  expect(key("ArrowRight")).toBe(false);
  view.select({ kind: "point", id });
  expect(key("ArrowRight")).toBe(true);
  expect(first().position[0]).toBeCloseTo((position[0] ?? 0) + 0.1, 12);
  key("PageUp", true);
  expect(first().position[2]).toBeCloseTo((position[2] ?? 0) + 1, 12);
  expect(key("Escape")).toBe(true);
  expect(view.state.getState().tool).toBe("select");
});

it("drags only held points in the mode of the select tool: selected ones, and those of selected lines", () => {
  const line = documents.project.lines.find(({ points }) => points.includes(first().id));
  if (!line) throw new Error("the point has no line");
  const held = new DragTool(
    { documents, view, drawing: new Drawing(), viewer: { seenFrom: fromAbove, pixelLength: 0.01 } },
    other,
    "held-points",
  );
  const target = { kind: "point", id: first().id } as const;
  const [x = 0, y = 0, z = 0] = first().position;
  expect(held.down(pointer(x, y, target))).toBe(false);
  expect(passed).toEqual(["down"]);
  view.select({ kind: "line", id: line.id });
  expect(held.down(pointer(x, y, { kind: "line", id: line.id }))).toBe(false);
  expect(held.down(pointer(x, y, target))).toBe(true);
  held.move(pointer(x + 0.3, y - 0.2, null));
  held.up(pointer(x + 0.3, y - 0.2, null));
  expect(first().position).toEqual([x + 0.3, y - 0.2, z]);
  expect(view.state.getState().selection).toEqual([{ kind: "line", id: line.id }]);

  const preview = documents.begin("Preview of an operation");
  expect(held.down(pointer(x + 0.3, y - 0.2, target))).toBe(false);
  preview.update(moveEntity("point", first().id, 2, 7));
  expect(first().position[2]).toBe(7);
});

it("does not end the preview of an operation by a press", () => {
  const [x = 0, y = 0] = first().position;
  const preview = documents.begin("Preview of an operation");
  expect(tool.down(pointer(x, y, { kind: "point", id: first().id }))).toBe(false);
  expect(view.state.getState().selection).toEqual([]);
  preview.update(moveEntity("point", first().id, 2, 7));
  expect(first().position[2]).toBe(7);
});

import type { ProjectBody } from "tetrafront/project";
import { beforeEach, expect, it } from "vitest";
import { moveEntity } from "../../../web/document/edits";
import { ViewStore } from "../../../web/document/selection";
import { DocumentStore } from "../../../web/session/document-store";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { DragTool, holdAll, holdPoints } from "../../../web/tools/drag-tool";
import type { ToolPointer } from "../../../web/tools/interaction";
import { MoveKeys } from "../../../web/tools/move-keys";
import type { Target } from "../../../web/viewer/layers/layer";
import type { Viewer } from "../../../web/viewer/viewer";
import { makeMotion, pressKeys } from "../../support/motion";
import { cubeProject } from "../../support/projects";

let documents: DocumentStore;
let view: ViewStore;
let drawing: Drawing;
let tool: DragTool;

beforeEach(() => {
  documents = new DocumentStore(cubeProject());
  view = new ViewStore();
  drawing = new Drawing();
  tool = new DragTool(stores(), holdAll);
});

function stores() {
  const motion = makeMotion({ documents, view, drawing, seenFrom: fromAbove });
  return { documents, view, motion, viewer: { seenFrom: fromAbove, pixelLength: 0.01 } };
}

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

/** Presses the first point, and releases the button elsewhere. Returns whether the release was used. */
function drag(target: Target, to: readonly [number, number], change: Partial<ToolPointer> = {}): boolean {
  const [x = 0, y = 0] = first().position;
  expect(tool.down(pointer(x, y, target))).toBe(true);
  tool.move(pointer(to[0], to[1], null, change));
  return tool.up(pointer(to[0], to[1], null, change));
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

it("stays exactly in the work plane without steps", () => {
  const { id, position } = first();
  documents.edit(moveEntity("point", id, 2, 1));
  /** In perspective, from an eye that is fixed. */
  const tilted: Viewer["seenFrom"] = (at) => {
    const origin = [0.3, -5, 4.1] as const;
    const [x, y, z] = [at.x / 100 - origin[0], at.y / 100 - origin[1], 1 - origin[2]];
    const length = Math.hypot(x, y, z);
    return { ...fromAbove(at), ray: { origin, direction: [x / length, y / length, z / length] } };
  };
  const motion = makeMotion({ documents, view, drawing, seenFrom: tilted });
  tool = new DragTool({ documents, view, motion, viewer: { seenFrom: tilted, pixelLength: 0.01 } }, holdAll);
  for (let i = 1; i <= 40; ++i) {
    const [x = 0, y = 0] = first().position;
    const to = [x + Math.sin(i), y + Math.cos(i)] as const;
    expect(tool.down(pointer(x, y, { kind: "point", id }))).toBe(true);
    tool.move(pointer(...to, null, { mod: true }));
    tool.up(pointer(...to, null, { mod: true }));
    expect(first().position[2]).toBe(1);
    expect(first().position).not.toEqual(position);
  }
});

it("restores everything when a drag is cancelled, and changes nothing by a click", () => {
  const { id, position } = first();
  tool.down(pointer(position[0] ?? 0, position[1] ?? 0, { kind: "point", id }));
  tool.move(pointer(5, 5, null));
  expect(first().position).not.toEqual(position);
  tool.cancel();
  expect(first().position).toEqual(position);
  // The click is left to the interactions that follow.
  expect(drag({ kind: "point", id }, [5, 5], { isDrag: false })).toBe(false);
  expect(first().position).toEqual(position);
  expect(past()).toBe(0);
});

it("leaves presses beside the model, and with Ctrl or Shift, to others", () => {
  const target: Target = { kind: "point", id: first().id };
  expect(tool.down(pointer(0, 0, null))).toBe(false);
  expect(tool.down(pointer(0, 0, target, { mod: true }))).toBe(false);
  expect(tool.down(pointer(0, 0, target, { shift: true }))).toBe(false);
  expect(tool.up(pointer(0, 0, target))).toBe(false);
});

it("moves the selection by arrow keys, ten steps with Shift; without a selection the camera gets the keys", () => {
  const { id, position } = first();
  const keys = new MoveKeys({ documents, view, viewer: { pixelLength: 0.01 } });
  const key = (name: string, shiftKey = false): boolean =>
    keys.key({ key: name, shiftKey, altKey: false, ctrlKey: false, metaKey: false } as KeyboardEvent);
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
  const held = new DragTool(stores(), holdPoints);
  const target = { kind: "point", id: first().id } as const;
  const [x = 0, y = 0, z = 0] = first().position;
  expect(held.down(pointer(x, y, target))).toBe(false);
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

/** Drags the first point without releasing it. */
function beginDrag(dx: number, dy: number): { readonly x: number; readonly y: number; readonly z: number } {
  const { id, position } = first();
  const [x = 0, y = 0, z = 0] = position;
  expect(tool.down(pointer(x, y, { kind: "point", id }))).toBe(true);
  tool.move(pointer(x + dx, y + dy, null));
  return { x, y, z };
}

it("takes typed numbers during a drag: offsets, an angle, a new place, or the distance dragged", () => {
  for (const [text, dx, dy, dz] of [
    ["@0.25,0.5,-1", 0.25, 0.5, -1],
    ["2<90", 0, 2, 0],
    ["7,8,9", 7, 8, 9],
    // The pointer has moved it along y.
    ["0.75", 0, -0.75, 0],
  ] as const) {
    const { x, y, z } = beginDrag(0, -0.4);
    const base = text === "7,8,9" ? [0, 0, 0] : [x, y, z];
    expect(pressKeys(tool, ...text)).toBe(true);
    expect(drawing.state.getState()).toMatchObject({ typed: text, motion: "translate" });
    const typed = first().position;
    // The pointer no longer decides, and the button may be released.
    tool.move(pointer(x + 3, y + 3, null));
    tool.up(pointer(x + 3, y + 3, null));
    expect(first().position).toEqual(typed);
    expect(pressKeys(tool, "Enter")).toBe(true);
    [dx, dy, dz].forEach((d, k) => expect(first().position[k]).toBeCloseTo((base[k] ?? 0) + d, 12));
    expect(drawing.state.getState()).toMatchObject({ typed: null, motion: null, amount: null });
    expect(past()).toBe(1);
    documents.undo();
    expect(first().position).toEqual([x, y, z]);
  }
});

it("cancels typed numbers by Escape, and leaves the pointer to decide while the button is held", () => {
  const { x, y, z } = beginDrag(0, -0.4);
  pressKeys(tool, "2", "Escape");
  tool.move(pointer(x + 0.3, y - 0.2, null));
  expect(first().position).toEqual([x + 0.3, y - 0.2, z]);
  pressKeys(tool, "2");
  tool.up(pointer(x + 0.3, y, null));
  pressKeys(tool, "Escape");
  expect(first().position).toEqual([x, y, z]);
  expect(past()).toBe(0);
  expect(documents.state.getState().gestureStart).toBeNull();
});

it("keeps to the axis of a key, for the pointer and for numbers", () => {
  const { x, y, z } = beginDrag(0.3, -0.4);
  expect(pressKeys(tool, "y")).toBe(true);
  tool.move(pointer(x + 0.3, y - 0.4, null));
  expect(first().position).toEqual([x, y - 0.4, z]);
  pressKeys(tool, "z", "-", "2", "Enter");
  // The release after Enter is no click.
  expect(tool.up(pointer(x + 0.3, y + 0.4, null, { isDrag: false }))).toBe(true);
  expect(first().position).toEqual([x, y, z - 2]);
  expect(past()).toBe(1);
});

it("moves a body by its patches, and leaves it selected by a click", () => {
  const body: ProjectBody = {
    id: 7,
    name: "ball",
    points: "",
    triangles: "",
    trianglePatch: "",
    patches: [{ id: 70 }],
  };
  documents = new DocumentStore({ ...cubeProject(), bodies: [body] });
  tool = new DragTool(stores(), holdAll);
  const patch: Target = { kind: "body-patch", id: 70 };
  const selected = () => view.state.getState().selection;
  expect(tool.down(pointer(0, 0, patch))).toBe(true);
  tool.up(pointer(0, 0, patch, { isDrag: false }));
  expect(selected()).toEqual([{ kind: "body", id: 7 }]);
  expect(past()).toBe(0);
  // Wherever it is taken, it moves by steps of the grid.
  expect(tool.down(pointer(0.0123, 0.0456, patch))).toBe(true);
  tool.move(pointer(0.51, 0.24, null));
  tool.up(pointer(0.51, 0.24, null));
  expect(documents.project.bodies?.[0]?.placement?.position).toEqual([0.5, 0.2, 0]);
  expect(selected()).toEqual([{ kind: "body", id: 7 }]);
});

it("leaves the selection to others by a press on what cannot be moved", () => {
  const patch: Target = { kind: "body-patch", id: 999 };
  view.select({ kind: "point", id: first().id });
  expect(tool.down(pointer(0, 0, patch))).toBe(false);
  expect(view.state.getState().selection).toEqual([{ kind: "point", id: first().id }]);
});

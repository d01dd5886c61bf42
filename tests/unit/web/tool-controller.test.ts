import { beforeEach, describe, expect, it, vi } from "vitest";
import { ToolController } from "../../../web/tools/tool-controller";
import type { Tool, ToolPointer } from "../../../web/tools/tool";
import type { Layer } from "../../../web/viewer/layers/layer";

/** A canvas at (100, 50) of the page, with only those members of an element that the controller uses. */
class Canvas extends EventTarget {
  readonly captured = new Set<number>();
  getBoundingClientRect = () => ({ left: 100, top: 50 });
  setPointerCapture = (id: number) => void this.captured.add(id);
  hasPointerCapture = (id: number) => this.captured.has(id);
  releasePointerCapture = (id: number) => void this.captured.delete(id);
}

class RecordingTool implements Tool {
  readonly id: string;
  readonly calls: string[] = [];
  readonly pointers: (ToolPointer | null)[] = [];
  claims = false;
  usesKeys = false;
  layer: Layer | null = null;

  constructor(id = "test") {
    this.id = id;
  }
  down(pointer: ToolPointer): boolean {
    this.#note("down", pointer);
    return this.claims;
  }
  move(pointer: ToolPointer | null): void {
    this.#note(pointer ? "move" : "leave", pointer);
  }
  up(pointer: ToolPointer): void {
    this.#note("up", pointer);
  }
  cancel(): void {
    this.calls.push("cancel");
  }
  key({ key }: KeyboardEvent): boolean {
    this.calls.push(`key ${key}`);
    return this.usesKeys;
  }
  overlay(): Layer | null {
    return this.layer;
  }
  #note(call: string, pointer: ToolPointer | null): void {
    this.calls.push(call);
    this.pointers.push(pointer);
  }
}

interface PointerInit {
  readonly x?: number;
  readonly y?: number;
  readonly id?: number;
  readonly button?: number;
  readonly buttons?: number;
  readonly time?: number;
  readonly pointerType?: string;
  readonly isPrimary?: boolean;
}

let canvas: Canvas;
let page: EventTarget;
let tool: RecordingTool;
let controller: ToolController;
let seenByCamera: string[];
const layers = { added: 0, removed: 0 };
const viewer = {
  hit: vi.fn(() => null),
  addLayer: () => {
    ++layers.added;
    return () => void ++layers.removed;
  },
};

beforeEach(() => {
  canvas = new Canvas();
  page = new EventTarget();
  vi.stubGlobal("window", page);
  tool = new RecordingTool();
  viewer.hit.mockClear();
  controller = new ToolController(canvas as unknown as HTMLElement, viewer, tool);
  seenByCamera = [];
  for (const type of ["pointerdown", "pointermove", "pointerup"]) {
    canvas.addEventListener(type, () => seenByCamera.push(type));
  }
});

function fire(type: string, init: PointerInit = {}): void {
  const { x = 10, y = 10, id = 1, button = 0, buttons = 0, time = 0, pointerType = "mouse" } = init;
  const event = new Event(type, { cancelable: true });
  const values = {
    clientX: 100 + x,
    clientY: 50 + y,
    pointerId: id,
    button,
    buttons,
    pointerType,
    timeStamp: time,
    isPrimary: init.isPrimary ?? true,
    shiftKey: false,
    ctrlKey: false,
    metaKey: false,
    altKey: false,
  };
  for (const [name, value] of Object.entries(values)) Object.defineProperty(event, name, { value });
  canvas.dispatchEvent(event);
}

function press(key: string, target: EventTarget | null = null): { used: boolean; reachedHotkeys: boolean } {
  let reachedHotkeys = false;
  const listener = (): void => void (reachedHotkeys = true);
  page.addEventListener("keydown", listener);
  const event = new Event("keydown", { cancelable: true });
  Object.defineProperty(event, "key", { value: key });
  Object.defineProperty(event, "target", { value: target });
  page.dispatchEvent(event);
  page.removeEventListener("keydown", listener);
  return { used: event.defaultPrevented, reachedHotkeys };
}

describe("a press that the tool does not claim", () => {
  it("is a click if the pointer stays, and the camera sees it", () => {
    fire("pointerdown");
    fire("pointermove", { x: 13, buttons: 1 });
    fire("pointerup", { x: 13 });
    expect(tool.calls).toEqual(["down", "up"]);
    expect(tool.pointers[1]).toMatchObject({
      at: { x: 13, y: 10 },
      button: "left",
      isDrag: false,
      clicks: 1,
    });
    expect(seenByCamera).toEqual(["pointerdown", "pointermove", "pointerup"]);
  });

  it("is cancelled when it becomes a drag, and then belongs to the camera", () => {
    fire("pointerdown");
    fire("pointermove", { x: 15, buttons: 1 });
    fire("pointermove", { x: 40, buttons: 1 });
    fire("pointerup", { x: 40 });
    expect(tool.calls).toEqual(["down", "cancel"]);
    expect(canvas.captured.size).toBe(0);
  });

  it("is cancelled by a second finger", () => {
    fire("pointerdown", { pointerType: "touch" });
    fire("pointerdown", { id: 2, isPrimary: false, pointerType: "touch" });
    fire("pointerup", { id: 2 });
    fire("pointerup");
    expect(tool.calls).toEqual(["down", "cancel"]);
    expect(seenByCamera).toContain("pointerdown");
  });

  it("is cancelled if the pointer leaves the view", () => {
    fire("pointerdown");
    fire("pointerleave");
    expect(tool.calls).toEqual(["down", "cancel", "leave"]);
  });

  it("counts clicks in quick succession at one position", () => {
    const click = (x: number, time: number): number | undefined => {
      fire("pointerdown", { x, time });
      fire("pointerup", { x, time: time + 50 });
      return tool.pointers.at(-1)?.clicks;
    };
    expect(click(10, 1000)).toBe(1);
    expect(click(12, 1300)).toBe(2);
    expect(click(12, 1600)).toBe(3);
    expect(click(12, 2300)).toBe(1);
    expect(click(40, 2400)).toBe(1);
  });
});

describe("a press that the tool claims", () => {
  beforeEach(() => {
    tool.claims = true;
  });

  it("is hidden from the camera until its end, with the pointer captured", () => {
    fire("pointerdown", { button: 1 });
    expect(canvas.captured).toEqual(new Set([1]));
    expect(controller.state.getState().hasGesture).toBe(true);
    fire("pointermove", { x: 12, buttons: 4 });
    fire("pointermove", { x: 60, buttons: 4 });
    fire("pointerleave");
    fire("pointerup", { x: 60 });
    expect(tool.calls).toEqual(["down", "move", "move", "up"]);
    expect(tool.pointers.map((pointer) => pointer?.isDrag)).toEqual([false, false, true, true]);
    expect(tool.pointers.every((pointer) => pointer?.button === "middle")).toBe(true);
    expect(seenByCamera).toEqual([]);
    expect(canvas.captured.size).toBe(0);
    expect(controller.state.getState().hasGesture).toBe(false);
  });

  it("is cancelled by Escape; the hotkeys receive no key during the press", () => {
    fire("pointerdown");
    expect(press("Delete")).toEqual({ used: false, reachedHotkeys: false });
    expect(press("Escape")).toEqual({ used: true, reachedHotkeys: false });
    expect(tool.calls).toEqual(["down", "key Delete", "cancel"]);
    fire("pointerup");
    expect(tool.calls).toHaveLength(3);
    expect(press("Delete").reachedHotkeys).toBe(true);
  });

  it.each(["pointercancel", "lostpointercapture"])("is cancelled by %s", (type) => {
    fire("pointerdown");
    fire(type, { id: 2 });
    expect(tool.calls).toEqual(["down"]);
    fire(type);
    expect(tool.calls).toEqual(["down", "cancel"]);
  });

  it("is cancelled when the window loses the focus", () => {
    fire("pointerdown");
    page.dispatchEvent(new Event("blur"));
    expect(tool.calls).toEqual(["down", "cancel"]);
  });

  it("also hides a second finger from the camera", () => {
    fire("pointerdown", { pointerType: "touch" });
    fire("pointerdown", { id: 2, isPrimary: false, pointerType: "touch" });
    expect(tool.calls).toEqual(["down"]);
    expect(seenByCamera).toEqual([]);
  });

  it("is cancelled when another tool takes over, which then gets the pointer", () => {
    fire("pointerdown");
    const next = new RecordingTool("next");
    controller.use(next);
    fire("pointerup");
    fire("pointermove");
    expect(tool.calls).toEqual(["down", "cancel", "leave"]);
    expect(next.calls).toEqual(["move"]);
    expect(controller.state.getState()).toEqual({ tool: "next", hasGesture: false });
  });
});

describe("without a press", () => {
  it("moves reach the tool, except those of a finger or with a pressed button", () => {
    fire("pointermove");
    fire("pointermove", { buttons: 1 });
    fire("pointermove", { pointerType: "touch" });
    fire("pointerleave");
    expect(tool.calls).toEqual(["move", "leave"]);
  });

  it("the hit test runs only if the tool asks, and once per event", () => {
    fire("pointermove", { x: 30, y: 40 });
    expect(viewer.hit).not.toHaveBeenCalled();
    tool.pointers[0]?.hit();
    tool.pointers[0]?.hit();
    expect(viewer.hit.mock.calls).toEqual([[{ x: 30, y: 40 }]]);
  });

  it("a key reaches the tool, and the hotkeys if the tool does not use it", () => {
    expect(press("a")).toEqual({ used: false, reachedHotkeys: true });
    tool.usesKeys = true;
    expect(press("b")).toEqual({ used: true, reachedHotkeys: false });
    expect(tool.calls).toEqual(["key a", "key b"]);
  });

  it("a key in a field or a dialog does not reach the tool", () => {
    tool.usesKeys = true;
    for (const selector of ["input", '[role="dialog"]']) {
      const target = Object.assign(new EventTarget(), {
        closest: (selectors: string) => (selectors.includes(selector) ? {} : null),
      });
      expect(press("x", target)).toEqual({ used: false, reachedHotkeys: true });
    }
    expect(tool.calls).toEqual([]);
  });

  it("the overlay of a tool is in the view while the tool is active", () => {
    Object.assign(layers, { added: 0, removed: 0 });
    const drawing = new RecordingTool("drawing");
    drawing.layer = {} as Layer;
    controller.use(drawing);
    expect(layers).toEqual({ added: 1, removed: 0 });
    controller.use(tool);
    expect(layers).toEqual({ added: 1, removed: 1 });
  });

  it("nothing reaches the tool after disposal, and two controllers share nothing", () => {
    const other = { canvas: new Canvas(), tool: new RecordingTool() };
    new ToolController(other.canvas as unknown as HTMLElement, viewer, other.tool);
    tool.claims = true;
    fire("pointerdown");
    expect(other.tool.calls).toEqual([]);
    controller.dispose();
    expect(tool.calls).toEqual(["down", "cancel", "leave"]);
    fire("pointermove");
    press("a");
    expect(tool.calls).toHaveLength(3);
  });
});

import { beforeEach, describe, expect, it, vi } from "vitest";
import { ToolController } from "../../../web/tools/tool-controller";
import type { Interaction, ToolPointer } from "../../../web/tools/interaction";
import type { Layer } from "../../../web/viewer/layers/layer";

/** A canvas at (100, 50) of the page, with only those members of an element that the controller uses. */
class Canvas extends EventTarget {
  readonly captured = new Set<number>();
  getBoundingClientRect = () => ({ left: 100, top: 50 });
  setPointerCapture = (id: number) => void this.captured.add(id);
  hasPointerCapture = (id: number) => this.captured.has(id);
  releasePointerCapture = (id: number) => void this.captured.delete(id);
}

class Recording implements Interaction {
  readonly calls: string[] = [];
  readonly pointers: (ToolPointer | null)[] = [];
  claims = false;
  /** Whether something of it lies under the pointer, and whether it uses a release and keys. */
  isUnder = false;
  usesRelease = true;
  usesKeys = false;
  down(pointer: ToolPointer): boolean {
    this.#note("down", pointer);
    return this.claims;
  }
  move(pointer: ToolPointer | null): boolean {
    this.#note(pointer ? "move" : "leave", pointer);
    return pointer !== null && this.isUnder;
  }
  up(pointer: ToolPointer): boolean {
    this.#note("up", pointer);
    return this.usesRelease;
  }
  cancel(): void {
    this.calls.push("cancel");
  }
  key({ key }: KeyboardEvent): boolean {
    this.calls.push(`key ${key}`);
    return this.usesKeys;
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
let tool: Recording;
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
  tool = new Recording();
  viewer.hit.mockClear();
  controller = new ToolController(canvas as unknown as HTMLElement, viewer);
  controller.use([tool]);
  tool.calls.length = 0;
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
    const next = new Recording();
    controller.use([next]);
    fire("pointerup");
    fire("pointermove");
    expect(tool.calls).toEqual(["down", "cancel", "leave"]);
    expect(next.calls).toEqual(["move"]);
    expect(controller.state.getState()).toEqual({ hasGesture: false });
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

  it("the overlays of all its interactions are in the view while a tool is active", () => {
    Object.assign(layers, { added: 0, removed: 0 });
    const drawing = (): Interaction => ({ overlay: () => ({}) as Layer });
    controller.use([drawing(), tool, drawing()]);
    expect(layers).toEqual({ added: 2, removed: 0 });
    controller.use([tool]);
    expect(layers).toEqual({ added: 2, removed: 2 });
  });

  it("nothing reaches the tool after disposal, and two controllers share nothing", () => {
    const other = { canvas: new Canvas(), tool: new Recording() };
    new ToolController(other.canvas as unknown as HTMLElement, viewer).use([other.tool]);
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

describe("a tool of several interactions", () => {
  let list: readonly [Recording, Recording, Recording];
  const calls = (): string[][] => list.map((interaction) => interaction.calls.splice(0));

  beforeEach(() => {
    list = [new Recording(), new Recording(), new Recording()];
    controller.use(list);
    calls();
  });

  it("the first that claims a press owns it until the release, and the others lose the pointer", () => {
    list[1].claims = list[2].claims = true;
    fire("pointerdown");
    expect(calls()).toEqual([["down", "leave"], ["down"], ["leave"]]);
    fire("pointermove", { x: 40, buttons: 1 });
    fire("pointerup", { x: 40 });
    expect(calls()).toEqual([[], ["move", "up"], []]);
    fire("pointermove", { x: 41 });
    expect(calls()).toEqual([["move"], ["move"], ["move"]]);
  });

  it("a release that its owner does not use goes to those after it", () => {
    list[1].claims = true;
    list[1].usesRelease = false;
    fire("pointerdown");
    calls();
    fire("pointerup");
    expect(calls()).toEqual([[], ["up"], ["up"]]);
  });

  it("a click goes to all in their order, until one uses it", () => {
    list[0].usesRelease = false;
    fire("pointerdown");
    fire("pointerup");
    expect(calls()).toEqual([["down", "up"], ["down", "up"], ["down"]]);
  });

  it("the first with something under the pointer hides it from those after it", () => {
    list[1].isUnder = list[2].isUnder = true;
    fire("pointermove");
    expect(calls()).toEqual([["move"], ["move"], ["leave"]]);
    list[1].isUnder = false;
    fire("pointermove");
    fire("pointerleave");
    expect(calls()).toEqual([
      ["move", "leave"],
      ["move", "leave"],
      ["move", "leave"],
    ]);
  });

  it("the first that uses a key has it; during a press only the owner is asked", () => {
    list[0].usesKeys = true;
    list[1].claims = true;
    press("a");
    expect(calls()).toEqual([["key a"], [], []]);
    fire("pointerdown");
    calls();
    expect(press("b")).toEqual({ used: false, reachedHotkeys: false });
    expect(calls()).toEqual([[], ["key b"], []]);
  });

  it("cancelling a press is told to all interactions, whichever owns it", () => {
    list[1].claims = true;
    fire("pointerdown");
    calls();
    press("Escape");
    expect(calls()).toEqual([["cancel"], ["cancel"], ["cancel"]]);
  });

  it("an interaction need not answer everything", () => {
    controller.use([{}, { key: () => true }, list[2]]);
    calls();
    fire("pointermove");
    fire("pointerdown");
    fire("pointerup");
    expect(press("a").used).toBe(true);
    expect(list[2].calls).toEqual(["move", "down", "up"]);
  });
});

/** How coordinates are typed while the field is closed, beside hotkeys. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { commandOfKey } from "../../../web/commands/registry";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { TypedKeys } from "../../../web/tools/drawing/typed-keys";

let drawing: Drawing;
let keys: TypedKeys;
let commands: string[];

beforeEach(() => {
  vi.useFakeTimers();
  drawing = new Drawing();
  drawing.begin({ takesCoordinates: true, take: () => null });
  commands = [];
  keys = new TypedKeys({
    drawing,
    named: () => new Map([["radius", 1], ["a", 2], ["gap", 3]]), // prettier-ignore
    hotkeyOf: (event) => {
      const command = commandOfKey(event);
      return command ? { label: command.id, run: () => commands.push(command.id) } : null;
    },
  });
});

afterEach(() => void vi.useRealTimers());

/** Presses keys as the page does: a key that coordinates do not use runs its command. */
function press(text: string): void {
  for (const key of text) {
    const event = { key, shiftKey: /[A-Z]/.test(key) };
    if (!keys.use(event)) {
      const command = commandOfKey(event);
      if (command) commands.push(command.id);
    }
  }
}

const typed = (): string | null => drawing.state.getState().typed;

describe("typed coordinates", () => {
  it.each([
    "1,2,0",
    "-1,2",
    "(1+2),0,0",
    "@1,0",
    "radius,0,0",
    // Their first letters are hotkeys.
    "sin(30),0,0",
    "pi/2,1,0",
    "pi-1,2,0",
    "abs(1),0,0",
    "cos(60)<30",
    "tan(45),0",
    "gap,0,0",
    "a,0,0",
    "a*2,0",
    "a-1,0",
  ])("%s comes into the field as it is typed, and runs no command", (text) => {
    // prettier-ignore
    press(text);
    expect(typed()).toBe(text);
    vi.runAllTimers();
    expect(commands).toEqual([]);
  });

  it("begin with any name after =", () => {
    press("=sin(30),0,0");
    expect(typed()).toBe("sin(30),0,0");
  });

  it("never lose their first number silently", () => {
    press("xyz,2,0");
    expect(typed()).toBe(",2,0");
    drawing.type(null);
    press("x*2,0,0");
    expect(typed()).toBe("*2,0,0");
  });

  it("are not opened by a comma or operator alone, which have hotkeys", () => {
    press(",<");
    expect(typed()).toBeNull();
  });

  it("follow the hotkey of a tool", () => {
    press("p1,2,0");
    expect(typed()).toBe("1,2,0");
    expect(commands).toEqual(["tool-point"]);
    drawing.type(null);
    press("l-1,2,0");
    expect(typed()).toBe("-1,2,0");
    expect(commands).toEqual(["tool-point", "tool-line"]);
  });
});

describe("a hotkey that begins a name", () => {
  it("runs after a moment, by Enter, or by another key", () => {
    press("p");
    expect(drawing.state.getState().waiting).toEqual({ letter: "p", command: "tool-point" });
    expect(commands).toEqual([]);
    vi.runAllTimers();
    expect(drawing.state.getState().waiting).toBeNull();
    expect(commands).toEqual(["tool-point"]);
    press("p");
    expect(keys.use({ key: "Enter", shiftKey: false })).toBe(true);
    press("pl");
    expect(commands).toEqual(["tool-point", "tool-point", "tool-point", "tool-line"]);
  });

  it("runs when the pointer moves, and is forgotten by Escape", () => {
    press("g");
    expect(keys.flushAt({ x: 2, y: 2 })).toBe(false);
    expect(keys.flushAt({ x: 20, y: 2 })).toBe(true);
    expect(commands).toEqual(["tool-move"]);
    press("g");
    expect(keys.use({ key: "Escape", shiftKey: false })).toBe(true);
    vi.runAllTimers();
    expect(commands).toEqual(["tool-move"]);
    expect(typed()).toBeNull();
  });

  it("leaves the next key to the page if its tool takes no coordinates", () => {
    keys = new TypedKeys({
      drawing,
      named: () => new Map(),
      hotkeyOf: ({ key }) => (key === "a" ? { label: "patch", run: () => drawing.end() } : null),
    });
    expect(keys.use({ key: "a", shiftKey: false })).toBe(true);
    expect(keys.use({ key: "1", shiftKey: false })).toBe(false);
    expect(typed()).toBeNull();
  });

  it("waits during Shift, which is needed for a parenthesis", () => {
    press("a");
    expect(keys.use({ key: "Shift", shiftKey: true })).toBe(false);
    press("*");
    expect(typed()).toBe("a*");
  });
});

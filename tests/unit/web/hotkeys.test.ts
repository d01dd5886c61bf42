import { playerOf } from "../../../web/teach/commands/player-of";
import { replayOf } from "../../../web/teach/teach";
import { beforeEach, describe, expect, it, vi } from "vitest";
import type { Mesher } from "tetrafront";
import { App } from "../../../web/app/app";
import { chordListener, hotkeyListener } from "../../../web/panels/page/hotkeys";
import { newDocument } from "../../../web/session/document-store";
import type { Viewer } from "../../../web/viewer/viewer";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";
import { SilentWorker } from "../../support/silent-worker";

/** A mesher whose previews never end. */
const busyMesher = Promise.resolve({
  previewProject: () => new Promise(() => undefined),
} as unknown as Mesher);

const newApp = (): App =>
  new App(
    {
      first: { document: newDocument(cubeProject()) },
      mesher: busyMesher,
      previewMesher: busyMesher,
      library: null,
    },
    { gallery: { opening: "", models: [] }, generate: false, still: true, replayOf },
  );

/** An element of the page that is in a dialog, in a field, or in neither. */
const element = (inside: string | null = null): EventTarget =>
  ({ closest: (selector: string) => (inside !== null && selector.includes(inside) ? {} : null) }) as never;

const press = (target: EventTarget, key: string, ctrlKey = false, shiftKey = false): KeyboardEvent =>
  ({
    key,
    ctrlKey,
    altKey: false,
    metaKey: false,
    shiftKey,
    target,
    preventDefault: () => undefined,
  }) as never;

beforeEach(() => {
  vi.stubGlobal("Worker", SilentWorker);
});

/** An app, with its listener for hotkeys. */
function listening() {
  const app = newApp();
  /** Returns whether the mesh is cut: X toggles it. */
  const isCut = (): boolean => app.view.state.getState().cut.enabled;
  return { app, send: hotkeyListener(app), isCut };
}

describe("hotkeys", () => {
  it("work without a focus, and do nothing in fields and dialogs, except those that work in fields", () => {
    const { app, send, isCut } = listening();
    for (const target of [element("input"), element('[role="dialog"]')]) send(press(target, "x"));
    expect(isCut()).toBe(false);
    send(press(element(), "x"));
    expect(isCut()).toBe(true);
    const generate = vi.spyOn(app.run, "generate").mockResolvedValue();
    send(press(element('[role="dialog"]'), "Enter", true));
    expect(generate).not.toHaveBeenCalled();
    send(press(element("input"), "Enter", true));
    expect(generate).toHaveBeenCalledTimes(1);
  });
});

describe("signs and digits", () => {
  it.each([
    ["?", true],
    ["?", false],
    ["F1", false],
  ])("the help opens by %s, with Shift: %s", (key, shift) => {
    const { app, send } = listening();
    send(press(element(), key, false, shift));
    expect(app.shell.getState().dialog).toBe("help");
  });

  it("a question mark is typed into a field, where F1 opens the help", () => {
    const { app, send } = listening();
    send(press(element("input"), "?", false, true));
    expect(app.shell.getState().dialog).toBeNull();
    send(press(element("input"), "F1"));
    expect(app.shell.getState().dialog).toBe("help");
  });

  it.each([false, true])("a digit chooses a view, with Shift: %s", (shift) => {
    const { app, send } = listening();
    const look = vi.fn();
    app.viewer.setState({ viewer: { look } as unknown as Viewer });
    send(press(element(), "7", false, shift));
    expect(look).toHaveBeenCalledWith("top");
  });
});

describe("chords", () => {
  /** An app with a control in each of some surroundings, and what its listener for chords does to an event. */
  function openOne() {
    vi.stubGlobal("document", { body: new EventTarget() });
    vi.stubGlobal("MouseEvent", class extends Event {});
    const app = newApp();
    const generate = vi.spyOn(app.run, "generate").mockResolvedValue();
    const listen = chordListener(app);
    const send = (target: EventTarget, key: string, ctrlKey = true): boolean => {
      const stopped = vi.fn();
      listen({ ...press(target, key, ctrlKey), preventDefault: stopped, stopPropagation: stopped });
      return stopped.mock.calls.length > 0;
    };
    return { app, generate, send };
  }

  it.each([null, '[role="menu"]', '[role="menubar"]', '[role="tree"]'])(
    "Ctrl Enter meshes and presses no control, in %s",
    (surroundings) => {
      const { generate, send } = openOne();
      expect(send(element(surroundings), "Enter")).toBe(true);
      expect(generate).toHaveBeenCalledTimes(1);
    },
  );

  it.each(["input", '[role="dialog"]'])("are left to %s", (surroundings) => {
    const { generate, send } = openOne();
    expect(send(element(surroundings), "Enter")).toBe(false);
    expect(generate).not.toHaveBeenCalled();
  });

  it("leave the keys of controls alone, and Ctrl A to trees", () => {
    const { app, send } = openOne();
    const control = element('[role="menu"]');
    for (const key of ["Enter", " ", "ArrowDown", "f"]) expect(send(control, key, false)).toBe(false);
    expect(send(element('[role="tree"]'), "a")).toBe(false);
    expect(app.view.state.getState().selection).toEqual([]);
  });
});

describe("the hotkeys of the player", () => {
  const { bytes } = starTrace(starSurface(boxSurface(6, [-1, -1, -1], [1, 1, 1])));

  type Key = readonly [key: string, shift: boolean];
  interface Layout {
    readonly farForward: readonly Key[];
    readonly farBack: readonly Key[];
  }
  /** What a keyboard sends for the keys that jump. */
  const layouts: Readonly<Record<string, Layout>> = {
    American: { farForward: [[">", true]], farBack: [["<", true]] },
    German: {
      farForward: [
        [":", true],
        [">", true],
      ],
      farBack: [
        [";", true],
        ["<", false],
      ],
    },
  };

  it("work while the heading of a lesson has the focus, and scroll a panel that has it", async () => {
    const app = newApp();
    await playerOf(app).open(bytes);
    const listen = hotkeyListener(app);
    const within = (...selectors: readonly string[]): EventTarget =>
      ({
        closest: (selector: string) => (selectors.some((inside) => selector.includes(inside)) ? {} : null),
      }) as never;
    const [heading, panel] = [within("h2", '[role="region"]'), within('[role="region"]')];
    const { stepCount = 0 } = playerOf(app).state.getState().trace ?? {};
    const { state } = playerOf(app);
    listen(press(panel, "End"));
    expect(state.getState().step).toBe(0);
    listen(press(heading, "End"));
    expect(state.getState().step).toBe(stepCount);
    listen(press(heading, "Home"));
    expect(state.getState().step).toBe(0);
    const toggle = vi.spyOn(playerOf(app), "toggle").mockImplementation(() => undefined);
    listen(press(heading, " "));
    expect(toggle).toHaveBeenCalledTimes(1);
  });

  it.each(Object.entries(layouts))("work on an %s keyboard", async (_, keys) => {
    const app = newApp();
    await playerOf(app).open(bytes);
    const listen = hotkeyListener(app);
    const stepAfter = (key: string, shift: boolean): number => {
      listen(press(element(), key, false, shift));
      return playerOf(app).state.getState().step;
    };
    expect(stepAfter(".", false)).toBe(1);
    expect(stepAfter(",", false)).toBe(0);
    for (const [key, shift] of keys.farForward) {
      playerOf(app).seek(50);
      expect(stepAfter(key, shift)).toBe(150);
    }
    for (const [key, shift] of keys.farBack) {
      playerOf(app).seek(150);
      expect(stepAfter(key, shift)).toBe(50);
    }
  });
});

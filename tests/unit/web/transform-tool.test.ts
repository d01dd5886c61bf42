import { PerspectiveCamera, Vector3 } from "three";
import { beforeEach, describe, expect, it, vi } from "vitest";
import type { Project } from "tetrafront/project";
import { moveEntity } from "../../../web/document/edits";
import { ViewStore } from "../../../web/document/selection";
import type { HandleMode } from "../../../web/document/tools";
import { DocumentStore } from "../../../web/session/document-store";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { TransformHandles } from "../../../web/tools/handles/transform-handles";
import type { ToolPointer } from "../../../web/tools/interaction";
import { TransformTool } from "../../../web/tools/transform-tool";
import { pointerView } from "../../../web/viewer/pointer-view";
import { SceneChanges } from "../../../web/viewer/scene-state";
import { makeMotion, pressKeys } from "../../support/motion";
import { cubeProject } from "../../support/projects";
import { frontCamera, sceneState, viewport } from "./scene";

let documents: DocumentStore;
let view: ViewStore;
let drawing: Drawing;
let tool: TransformTool;
let commands: string[];

/** Shows the handles around a selected project, seen along y. */
async function shown(project: Project, handleMode: HandleMode): Promise<void> {
  documents = new DocumentStore(project);
  view = new ViewStore();
  drawing = new Drawing();
  commands = [];
  view.selectAll([
    ...project.points.map(({ id }) => ({ kind: "point", id }) as const),
    ...project.lines.map(({ id }) => ({ kind: "line", id }) as const),
  ]);
  view.state.setState({ handleMode });
  const camera = frontCamera();
  const seenFrom = (at: ToolPointer["at"]) => pointerView(camera, viewport, [0, 0, 0], at);
  const viewer = { camera, seenFrom, size: viewport, pixelLength: 0.01, requestFrame: () => undefined };
  const hotkeyOf = ({ key }: { readonly key: string }) =>
    key === "c" ? { label: key, run: () => void commands.push(key) } : null;
  const motion = makeMotion({ documents, view, drawing, seenFrom, hotkeyOf });
  tool = new TransformTool({ documents, view, motion, viewer });
  const overlay = tool.overlay();
  const state = sceneState({ ...view.state.getState(), project });
  overlay.update(new SceneChanges(state, null));
  await vi.waitFor(() => expect(overlay.root.children).toHaveLength(1));
  overlay.root.updateMatrixWorld(true);
}

const pointer = (x: number, y: number, change: Partial<ToolPointer> = {}): ToolPointer => ({
  at: { x, y },
  button: "left",
  shift: false,
  mod: false,
  alt: false,
  touch: false,
  isDrag: true,
  clicks: 1,
  hit: () => null,
  ...change,
});

/** Presses the first handle to the right of the middle of the view; returns where. */
function pressRight(height = 0): number {
  for (let x = viewport.width; x > viewport.width / 2; x -= 0.5) {
    if (tool.down(pointer(x, viewport.height / 2 - height))) return x;
  }
  throw new Error("there is no handle");
}

const centred = (): Project => {
  const cube = cubeProject();
  const points = cube.points.map((point) => ({
    ...point,
    position: point.position.map((x) => x - 0.5) as [number, number, number],
  }));
  return { ...cube, points };
};
const positions = () => documents.project.points.map(({ position }) => position);

describe("the handles of a selection", () => {
  let before: readonly (readonly number[])[];

  beforeEach(() => {
    before = centred().points.map(({ position }) => position);
  });

  it("move along an axis by steps of the grid, as one step of undo", async () => {
    await shown(centred(), "translate");
    const x = pressRight();
    tool.move(pointer(x + 13, 50));
    tool.move(pointer(x + 20.3, 55));
    expect(drawing.state.getState().amount).toMatch(/^Δ [\d.]+, 0, 0$/);
    tool.up(pointer(x + 20.3, 55));
    const moved = (positions()[0]?.[0] ?? NaN) - (before[0]?.[0] ?? NaN);
    expect(moved).toBeGreaterThan(1.5);
    expect(moved).toBeLessThan(2.5);
    expect((10 * moved) % 1).toBeCloseTo(0, 9);
    positions().forEach((position, i) => {
      expect(position[0] - (before[i]?.[0] ?? 0)).toBeCloseTo(moved, 12);
      expect(position.slice(1)).toEqual(before[i]?.slice(1));
    });
    expect(documents.state.getState().history.past.map(({ label }) => label)).toEqual(["Move selection"]);
    documents.undo();
    expect(positions()).toEqual(before);
  });

  it("are cancelled without a trace", async () => {
    await shown(centred(), "translate");
    const x = pressRight();
    tool.move(pointer(x + 30, 50));
    expect(positions()).not.toEqual(before);
    tool.cancel();
    expect(drawing.state.getState().amount).toBeNull();
    expect(positions()).toEqual(before);
    expect(documents.state.getState().history.past).toEqual([]);
  });

  it("change nothing by a click, and join nothing", async () => {
    const project = centred();
    const [first] = project.points;
    if (!first) throw new Error("the cube has no points");
    await shown({ ...project, points: [...project.points, { ...first, id: 100 }] }, "translate");
    const given = documents.project;
    const x = pressRight();
    tool.move(pointer(x + 1, 50, { isDrag: false }));
    expect(documents.project).toBe(given);
    tool.up(pointer(x + 1, 50, { isDrag: false }));
    expect(documents.project).toBe(given);
    expect(documents.state.getState()).toMatchObject({ gestureStart: null, history: { past: [] } });
  });

  it("rotate by steps of 15 degrees about the middle, and keep all distances", async () => {
    await shown(centred(), "rotate");
    const x = pressRight();
    tool.move(pointer(x - 6, 20));
    tool.up(pointer(x - 6, 20));
    const radii = (list: readonly (readonly number[])[]) => list.map((p) => Math.hypot(...p));
    expect(positions()).not.toEqual(before);
    radii(positions()).forEach((radius, i) => expect(radius).toBeCloseTo(radii(before)[i] ?? 0, 12));
    const [p, q] = [positions()[0], before[0]];
    if (!p || !q) throw new Error("the cube has no points");
    expect(documents.state.getState().history.past).toHaveLength(1);
  });

  it("scale along one axis by steps of a tenth", async () => {
    await shown(centred(), "scale");
    const x = pressRight();
    tool.move(pointer(x + 9, 50));
    tool.up(pointer(x + 9, 50));
    const factor = (positions()[0]?.[0] ?? 0) / (before[0]?.[0] ?? 1);
    expect(factor).toBeGreaterThan(1.05);
    expect((10 * factor) % 1).toBeCloseTo(0, 9);
    positions().forEach((position, i) => expect(position.slice(1)).toEqual(before[i]?.slice(1)));
  });

  it("refuse to flatten circles, and say why", async () => {
    const cube = centred();
    const [a, b, c] = cube.points.map(({ id }) => id);
    if (!a || !b || !c) throw new Error("the cube has no points");
    await shown({ ...cube, lines: [{ id: 99, type: "arc", points: [a, b, c] }], patches: [] }, "scale");
    const x = pressRight();
    tool.move(pointer(x + 9, 50));
    expect(drawing.state.getState().refused).toMatch(/round/);
    tool.up(pointer(x + 9, 50));
    expect(positions()).toEqual(before);
    expect(documents.state.getState().history.past).toEqual([]);
    expect(drawing.state.getState()).toMatchObject({ amount: null, refused: null });
  });

  it("show the selection as it was while typed numbers are refused, and keep the field open", async () => {
    const cube = centred();
    const [a, b, c] = cube.points.map(({ id }) => id);
    if (!a || !b || !c) throw new Error("the cube has no points");
    await shown({ ...cube, lines: [{ id: 99, type: "arc", points: [a, b, c] }], patches: [] }, "scale");
    pressKeys(tool, "2");
    expect(positions()).not.toEqual(before);
    pressKeys(tool, ",", "1", ",", "1");
    expect(positions()).toEqual(before);
    pressKeys(tool, "Enter");
    expect(drawing.state.getState()).toMatchObject({ typed: "2,1,1", mistake: "refused" });
    expect(drawing.state.getState().refused).toMatch(/round/);
    // Others must not edit the model meanwhile: what is typed next would replace their edits.
    expect(documents.state.getState().gestureStart).not.toBeNull();
    drawing.type("");
    expect(drawing.state.getState().refused).toBeNull();
    drawing.type("2,1,1");
    drawing.type("2");
    expect(positions()).not.toEqual(before);
    drawing.submit();
    expect(drawing.state.getState().typed).toBeNull();
    expect(documents.state.getState().history.past).toHaveLength(1);
  });

  it("leave everything else to others", async () => {
    await shown(centred(), "translate");
    expect(tool.move(pointer(1, 1, { button: null }))).toBe(false);
    expect(tool.down(pointer(1, 1))).toBe(false);
    expect(tool.up(pointer(1, 1))).toBe(false);
  });

  it("take a typed distance along their axis, or along the axis of a key", async () => {
    await shown(centred(), "translate");
    const x = pressRight();
    tool.move(pointer(x + 20, 50));
    expect(pressKeys(tool, "0", ".", "3", "7", "Enter")).toBe(true);
    tool.up(pointer(x + 20, 50));
    positions().forEach(([px, ...others], i) => {
      expect(px - (before[i]?.[0] ?? 0)).toBeCloseTo(0.37, 12);
      expect(others).toEqual(before[i]?.slice(1));
    });
    expect(pressKeys(tool, "Z", "2", "Enter")).toBe(true);
    positions().forEach(([, , z], i) => expect(z - (before[i]?.[2] ?? 0)).toBe(2));
    expect(documents.state.getState().history.past).toHaveLength(2);
  });

  it("take typed numbers without a drag: one step of undo by Enter, none by Escape", async () => {
    await shown(centred(), "translate");
    expect(pressKeys(tool, "1", "Tab", "2")).toBe(true);
    expect(drawing.state.getState().typed).toBe("@1,2");
    positions().forEach((p, i) => expect(p).toEqual([(before[i]?.[0] ?? 0) + 1, (before[i]?.[1] ?? 0) + 2, before[i]?.[2]])); // prettier-ignore
    pressKeys(tool, "Escape");
    expect(positions()).toEqual(before);
    expect(documents.state.getState()).toMatchObject({ gestureStart: null, history: { past: [] } });
    // Other keys keep their meaning.
    expect(pressKeys(tool, "f")).toBe(false);
    expect(drawing.state.getState().motion).toBeNull();
  });

  it("move what is selected when a number is typed, after a waiting letter became a command", async () => {
    await shown(centred(), "translate");
    vi.useFakeTimers();
    try {
      const [a, b] = documents.project.points;
      if (!a || !b) throw new Error("there are no points");
      view.select({ kind: "point", id: a.id });
      expect(pressKeys(tool, "c")).toBe(true);
      expect(drawing.state.getState().waiting?.letter).toBe("c");
      expect(pressKeys(tool, "Shift")).toBe(false);
      expect(drawing.state.getState()).toMatchObject({ waiting: { letter: "c" }, motion: null });
      vi.runAllTimers();
      expect(commands).toEqual(["c"]);
      documents.edit(moveEntity("point", a.id, 1, 7));
      view.select({ kind: "point", id: b.id });
      pressKeys(tool, "5", "Enter");
      expect(positions()[0]?.[1]).toBe(7);
      expect(positions()[0]?.[0]).toBe(a.position[0]);
      expect(positions()[1]?.[0]).toBe(b.position[0] + 5);
      // The letter may also begin what is typed.
      expect(pressKeys(tool, "c", "o", "s", "(", "0", ")", "Enter")).toBe(true);
      expect(positions()[1]?.[0]).toBe(b.position[0] + 6);
      expect(commands).toEqual(["c"]);
    } finally {
      vi.useRealTimers();
    }
  });

  it("run no command during a drag", async () => {
    await shown(centred(), "translate");
    vi.useFakeTimers();
    try {
      pressKeys(tool, "c");
      const x = pressRight();
      expect(drawing.state.getState().waiting).toBeNull();
      tool.move(pointer(x + 20, 50));
      pressKeys(tool, "c");
      vi.runAllTimers();
      expect(commands).toEqual([]);
      expect(drawing.state.getState().typed).toBe("c");
      tool.cancel();
      expect(drawing.state.getState().typed).toBeNull();
    } finally {
      vi.useRealTimers();
    }
  });

  it.each([
    ["rotate", "90", [0.5, -0.5]],
    ["scale", "3", [-1.5, -1.5]],
  ] as const)("%s by a typed number", async (mode, text, [x, y]) => {
    await shown(centred(), mode);
    const at = before.findIndex(([bx, by]) => bx === -0.5 && by === -0.5);
    pressKeys(tool, ...text, "Enter");
    expect(positions()[at]?.[0]).toBeCloseTo(x, 12);
    expect(positions()[at]?.[1]).toBeCloseTo(y, 12);
    expect(documents.state.getState().history.past).toHaveLength(1);
    pressKeys(tool, "-", "<", "Enter");
    expect(drawing.state.getState().mistake).toBe(mode === "rotate" ? "no-angle" : "no-factor");
  });
});

it("squares of two axes are taken where they are drawn, although arrows reach there, too", () => {
  const camera = new PerspectiveCamera(35, 1.5, 0.1, 100);
  camera.up.set(0, 0, 1);
  camera.position.set(3.5, -4.5, 2.8);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  const handles = new TransformHandles(camera);
  handles.setMode("translate");
  handles.place([0, 0, 0], [0, 0, 0]);
  // The middles of the squares lie at 0.15 of this length along both axes.
  const length = (camera.position.length() * 1.9 * Math.tan((35 / 360) * Math.PI)) / 4;
  for (const [a, b] of [
    [0, 1],
    [1, 2],
    [0, 2],
  ] as const) {
    // prettier-ignore
    const middle = [0, 0, 0];
    middle[a] = middle[b] = 0.15 * length;
    const at = new Vector3(...middle).project(camera);
    expect(handles.hover(at)).toBe(true);
    handles.press(at);
    const { numbers } = handles.drag({ x: at.x + 0.1, y: at.y + 0.17 }, { length: 0, angle: 0, factor: 0 });
    handles.release(at);
    handles.place([0, 0, 0], [0, 0, 0]);
    expect(numbers.map((number) => number !== 0)).toEqual([0, 1, 2].map((k) => k === a || k === b));
  }
  handles.dispose();
});

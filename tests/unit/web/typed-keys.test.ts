import { expect, it, vi } from "vitest";
import { createStore } from "zustand/vanilla";
import { ViewStore } from "../../../web/document/selection";
import { emptyProject } from "../../../web/document/create";
import type { DraftEdit } from "../../../web/document/edit";
import { offerLineSplit } from "../../../web/document/splits/split-line";
import { DocumentStore, newDocument } from "../../../web/session/document-store";
import type { PreviewFeed } from "../../../web/session/preview";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { LineTool } from "../../../web/tools/drawing/line-tool";
import type { ToolPointer } from "../../../web/tools/interaction";
import { NodeTool } from "../../../web/tools/drawing/node-tool";
import { DrawingLayer } from "../../../web/viewer/layers/drawing-layer";

const key = (name: string): KeyboardEvent =>
  ({ key: name, ctrlKey: false, metaKey: false, altKey: false }) as KeyboardEvent;

function makeStores() {
  const documents = new DocumentStore(emptyProject());
  const drawing = new Drawing();
  const previews = { state: createStore(() => ({ preview: null, project: null })) };
  const viewer = {
    seenFrom: () => ({
      pointer: { x: 0, y: 0 },
      ray: { origin: [0, 0, 9] as const, direction: [0, 0, -1] as const },
      toScreen: () => null,
    }),
    pixelLength: 0.01,
    requestFrame: () => undefined,
  };
  return {
    documents,
    previews: previews as unknown as PreviewFeed,
    view: new ViewStore(),
    drawing,
    viewer,
  };
}

it("keys that are pressed before the field has opened are not lost, and four typed nodes make a tetrahedron", () => {
  const stores = makeStores();
  const { documents, drawing } = stores;
  const tool = new NodeTool(stores);
  tool.overlay();
  for (const text of ["5.2,0,0", "0,1,0", "0,0,1", "0,0,0"]) {
    for (const character of text) expect(tool.key(key(character))).toBe(true);
    expect(drawing.state.getState().typed).toBe(text);
    expect(tool.key(key("Enter"))).toBe(true);
    expect(drawing.state.getState().typed).toBeNull();
  }
  const { nodes, tetrahedra } = documents.project.background;
  expect(nodes.map(({ position }) => position.join())).toEqual(["5.2,0,0", "0,1,0", "0,0,1", "0,0,0"]);
  expect(tetrahedra).toEqual([[1, 2, 3, 4]]);
  documents.undo();
  expect(documents.project.background.tetrahedra).toEqual([]);
});

it.each(["circle", "arc"] as const)("a typed number is the radius of a %s", (lineType) => {
  const stores = makeStores();
  const { documents, drawing, view } = stores;
  view.state.setState({ lineType });
  const tool = new LineTool(stores);
  tool.overlay();
  expect(tool.take("2")).toBe("syntax");
  expect(tool.take("1,0,0")).toBeNull();
  if (lineType === "arc") expect(tool.take("3,0,0")).toBeNull();
  expect(tool.take("-1")).toBe("no-radius");
  if (lineType === "arc") expect(tool.take("0.5")).toBe("short-radius");
  expect(documents.project.lines).toHaveLength(0);
  expect(tool.take("sqrt(4)")).toBeNull();
  expect(drawing.state.getState().mistake).toBeNull();
  const { lines, points } = documents.project;
  expect(lines.map(({ type }) => type)).toEqual([lineType]);
  const centre = lineType === "circle" ? [1, 0, 0] : [2, -Math.sqrt(3), 0];
  for (const { position } of points) {
    expect(Math.hypot(...position.map((x, k) => x - (centre[k] ?? 0)))).toBeCloseTo(2, 12);
    expect(position[2]).toBe(0);
  }
});

it.each([
  ["circle", ["1,0,0"], "2", "radius", (x: number, y: number) => Math.hypot(x - 1, y) - 2],
  [
    "arc",
    ["1,0,0", "3,0,0"],
    "2",
    "radius",
    (x: number, y: number) => Math.hypot(x - 2, y + Math.sqrt(3)) - 2,
  ],
  ["straight", ["1,0,0"], "@2,1,0", "typed", (x: number, y: number) => x - 1 - 2 * y],
] as const)("a %s is shown while it is typed, and the place under the pointer otherwise", (...example) => {
  const [lineType, places, text, kind, errorAt] = example;
  const shown = vi.spyOn(DrawingLayer.prototype, "show");
  const stores = makeStores();
  const { drawing, documents, view } = stores;
  view.state.setState({ lineType });
  const tool = new LineTool(stores);
  tool.overlay();
  for (const place of places) expect(tool.take(place)).toBeNull();
  const snap = () => drawing.state.getState().snap;
  drawing.type(text);
  expect(snap()?.kind).toBe(kind);
  const [path = []] = shown.mock.lastCall?.[0].paths ?? [];
  expect(path.length).toBeGreaterThan(lineType === "straight" ? 1 : 8);
  for (const [x, y] of path) expect(errorAt(x, y)).toBeCloseTo(0, 12);
  drawing.type(`${text}*`);
  expect(snap()).toBeNull();
  drawing.type(text);
  drawing.type(null);
  expect(snap()).toBeNull();
  expect(documents.project.lines).toHaveLength(0);
  drawing.type(text);
  drawing.submit();
  expect(snap()).toBeNull();
  expect(documents.project.lines.map(({ type }) => type)).toEqual([lineType]);
  shown.mockRestore();
});

it("what is typed stays shown while the pointer moves or leaves; then the place under the pointer is shown", () => {
  const stores = makeStores();
  const { drawing } = stores;
  const tool = new LineTool(stores);
  tool.overlay();
  const snap = () => drawing.state.getState().snap;
  const pointer = { at: { x: 0, y: 0 }, mod: true, hit: () => null } as unknown as ToolPointer;
  const typed = { kind: "typed", position: [2, 1, 0] };
  drawing.type("2,1,0");
  tool.move(pointer);
  expect(snap()).toMatchObject(typed);
  drawing.type("2,1,0*");
  expect(snap()).toMatchObject({ kind: "plane", position: [0, 0, 0] });
  drawing.type("2,1,0");
  tool.move(null);
  expect(snap()).toMatchObject(typed);
  tool.move(pointer);
  drawing.type(null);
  expect(snap()).toMatchObject({ kind: "plane", position: [0, 0, 0] });
  drawing.type("2,1,0");
  tool.move(null);
  drawing.type(null);
  expect(snap()).toBeNull();
});

/** The line tool, drawing a chain of straight lines. */
function startChain(...places: readonly string[]) {
  const stores = makeStores();
  const tool = new LineTool(stores);
  tool.overlay();
  for (const place of places) expect(tool.take(place)).toBeNull();
  const ends = () => stores.documents.project.lines.map(({ points }) => points.join());
  return { ...stores, tool, ends };
}

it("undo takes back the last line of a chain, which goes on from the point before", () => {
  const { documents, drawing, tool, ends } = startChain("0,0,0", "1,0,0", "1,1,0", "5,5,0");
  expect(ends()).toEqual(["1,2", "2,3", "3,4"]);
  documents.undo();
  expect(drawing.state.getState().picked).toBe(1);
  expect(tool.take("0,1,0")).toBeNull();
  expect(ends()).toEqual(["1,2", "2,3", "3,4"]);
  expect(documents.project.points.at(-1)?.position).toEqual([0, 1, 0]);
  // The first place closes the chain; without its last line, it is open again.
  expect(tool.take("0,0,0")).toBeNull();
  expect(drawing.state.getState().picked).toBe(0);
  documents.undo();
  expect(drawing.state.getState().picked).toBe(1);
  expect(tool.take("0,2,0")).toBeNull();
  expect(ends().at(-1)).toBe("4,5");
});

it("redo goes on at the end of the chain, and undo of all its lines at its first place", () => {
  const { documents, tool, ends } = startChain("0,0,0", "1,0,0", "1,1,0");
  documents.undo();
  documents.redo();
  expect(tool.take("0,1,0")).toBeNull();
  expect(ends()).toEqual(["1,2", "2,3", "3,4"]);
  for (let count = ends().length; count > 0; --count) documents.undo();
  expect(documents.project.points).toEqual([]);
  expect(tool.take("0,0,1")).toBeNull();
  expect(documents.project.points.map(({ position }) => position.join())).toEqual(["0,0,0", "0,0,1"]);
});

it("a closed chain ends: the next place begins another one", () => {
  const { documents, drawing, tool, ends } = startChain("0,0,0", "1,0,0", "0,1,0", "0,0,0");
  for (const place of ["5,0,0", "6,0,0", "5,1,0", "5,0,0"]) expect(tool.take(place)).toBeNull();
  expect(ends()).toEqual(["1,2", "2,3", "3,1", "4,5", "5,6", "6,4"]);
  expect(drawing.state.getState().picked).toBe(0);
  // A line to the first place of the chain before closes nothing.
  for (const place of ["9,0,0", "0,0,0", "9,9,0"]) expect(tool.take(place)).toBeNull();
  expect(ends().slice(6)).toEqual(["7,1", "1,8"]);
  documents.undo();
  documents.undo();
  // The place before the first line belongs to no step.
  expect(drawing.takeBack()).toBe(true);
  expect(drawing.state.getState().picked).toBe(0);
  expect(ends()).toHaveLength(6);
});

it("after undo, a line of another step that has the same id is no line of the chain", () => {
  const { documents, drawing, tool, ends } = startChain("0,0,0", "1,0,0", "2,0,0");
  const add = (...points: readonly [number, number]): void => {
    const change: DraftEdit["change"] = ({ project }) => {
      for (const id of points) {
        if (!project.points.some((point) => point.id === id))
          project.points.push({ id, position: [id, 7, 0] });
      }
      project.lines.push({ id: project.lines.length + 1, type: "straight", points: [...points] });
    };
    documents.edit({ label: "Paste", change });
  };
  documents.undo();
  add(3, 4);
  expect(drawing.state.getState().picked).toBe(1);
  expect(tool.take("1,1,0")).toBeNull();
  expect(ends()).toEqual(["1,2", "3,4", "2,5"]);
  while (ends().length > 0) documents.undo();
  // Even if its points have the same ids.
  add(1, 2);
  expect(tool.take("1,1,0")).toBeNull();
  expect(documents.project.points.at(-2)?.position).toEqual([0, 0, 0]);
  expect(ends()).toEqual(["1,2", "3,4"]);
});

it("a chain goes on after its last line was split", () => {
  const { documents, tool, ends } = startChain("0,0,0", "1,0,0", "3,0,0");
  const offer = offerLineSplit(documents.project, [{ kind: "line", id: 2 }], [2, 0, 0]);
  if (!offer.possible) throw new Error(offer.reason);
  documents.edit(offer.creation.edit);
  expect(tool.take("3,1,0")).toBeNull();
  expect(ends().at(-1)).toBe("3,5");
});

it("another document ends the chain", () => {
  const { documents, drawing, tool, ends } = startChain("0,0,0", "1,0,0", "2,0,0");
  documents.show(newDocument(structuredClone(documents.project)));
  expect(drawing.state.getState().picked).toBe(0);
  expect(tool.take("5,0,0")).toBeNull();
  expect(ends()).toHaveLength(2);
});

it.each(["straight", "parabolic", "spline"] as const)(
  "places of a %s line that does not exist yet are taken back before steps are undone",
  (lineType) => {
    const { documents, drawing, view, tool, ends } = startChain();
    view.state.setState({ lineType });
    const places = lineType === "straight" ? ["0,0,0"] : ["0,0,0", "1,0,0"];
    for (const place of places) expect(tool.take(place)).toBeNull();
    for (let count = places.length; count > 0; --count) expect(drawing.takeBack()).toBe(true);
    expect(drawing.takeBack()).toBe(false);
    expect(documents.state.getState().history.past).toEqual([]);
    for (const place of ["5,0,0", "6,1,0", "7,0,0"]) expect(tool.take(place)).toBeNull();
    expect(drawing.takeBack()).toBe(lineType === "spline");
    expect(ends()).toEqual({ straight: ["1,2", "2,3"], parabolic: ["1,2,3"], spline: [] }[lineType]);
  },
);

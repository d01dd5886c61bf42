import { expect, it } from "vitest";
import { createStore } from "zustand/vanilla";
import { ViewStore } from "../../../web/document/selection";
import { emptyProject } from "../../../web/document/create";
import { DocumentStore } from "../../../web/session/document-store";
import type { PreviewFeed } from "../../../web/session/preview";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { NodeTool } from "../../../web/tools/drawing/node-tool";

const key = (name: string): KeyboardEvent =>
  ({ key: name, ctrlKey: false, metaKey: false, altKey: false }) as KeyboardEvent;

it("keys that are pressed before the field has opened are not lost, and four typed nodes make a tetrahedron", () => {
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
  const stores = {
    documents,
    previews: previews as unknown as PreviewFeed,
    view: new ViewStore(),
    drawing,
    viewer,
  };
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

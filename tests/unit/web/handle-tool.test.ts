import { noSolids } from "../../support/no-solids";
import { expect, it } from "vitest";
import { ViewStore } from "../../../web/document/selection";
import { DocumentStore } from "../../../web/session/document-store";
import { Operations } from "../../../web/session/operations";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { HandleTool } from "../../../web/tools/handle-tool";
import type { ToolPointer } from "../../../web/tools/interaction";
import { SceneChanges } from "../../../web/viewer/scene-state";
import type { Viewer } from "../../../web/viewer/viewer";
import { cubeProject } from "../../support/projects";
import { sceneState } from "./scene";

/** From above, without perspective: 100 pixels per unit. */
const seenFrom: Viewer["seenFrom"] = (at) => ({
  pointer: at,
  ray: { origin: [at.x / 100, at.y / 100, 10], direction: [0, 0, -1] },
  toScreen: ([x, y]) => ({ x: 100 * x, y: 100 * y }),
});

const pointer = (x: number, y: number): ToolPointer => ({
  at: { x, y },
  button: "left",
  shift: false,
  mod: false,
  alt: false,
  touch: false,
  isDrag: true,
  clicks: 1,
  hit: () => null,
});

it("takes hold of the handles of a node, unless an operation has a preview", () => {
  const project = cubeProject();
  const [node] = project.background.nodes;
  if (!node) throw new Error("the cube has no background grid");
  const documents = new DocumentStore(project);
  const view = new ViewStore();
  view.select({ kind: "background-node", id: node.id });
  const viewer = {
    seenFrom,
    pixelLength: 0.01,
    requestFrame: () => undefined,
    onDrawn: () => () => undefined,
  };
  const drawing = new Drawing();
  const operations = new Operations(documents, view, noSolids);
  const tool = new HandleTool({ documents, operations, view, drawing, viewer });
  const state = sceneState({ ...view.state.getState(), project });
  tool.overlay().update(new SceneChanges(state, null));
  const [x, y] = [100 * node.position[0], 100 * node.position[1]];
  let held: ToolPointer | null = null;
  for (let radius = 0; radius < 500 && !held; radius += 4) {
    for (let degrees = 0; degrees < 360 && !held; degrees += 15) {
      const angle = (degrees * Math.PI) / 180;
      const at = pointer(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
      if (tool.down(at)) held = at;
    }
  }
  if (!held) throw new Error("there is no handle");
  tool.cancel();

  // What a handle changes is shown beside the pointer, until it leaves.
  expect(tool.move({ ...held, button: null })).toBe(true);
  expect(drawing.state.getState().amount).toMatch(/^(Size|Stretching) \d/);
  expect(tool.move({ ...pointer(-9000, 0), button: null })).toBe(false);
  expect(drawing.state.getState().amount).toBeNull();

  const preview = documents.begin("Preview of an operation");
  const { gestureStart } = documents.state.getState();
  expect(tool.down(held)).toBe(false);
  expect(documents.state.getState().gestureStart).toBe(gestureStart);
  preview.cancel();
  expect(tool.down(held)).toBe(true);
});

import { expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { ViewStore } from "../../../web/document/selection";
import { DocumentStore } from "../../../web/session/document-store";
import type { PreviewFeed } from "../../../web/session/preview";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { MeasureTool } from "../../../web/tools/drawing/measure-tool";
import type { Viewer } from "../../../web/viewer/viewer";

const seenFrom: Viewer["seenFrom"] = (at) => ({
  pointer: at,
  ray: { origin: [at.x / 100, at.y / 100, 10], direction: [0, 0, -1] },
  toScreen: ([x, y]) => ({ x: 100 * x, y: 100 * y }),
});

it("forgets its places when another tool is taken", () => {
  const drawing = new Drawing();
  const tool = new MeasureTool({
    documents: new DocumentStore(emptyProject(), () => 0),
    previews: { state: { getState: () => ({ preview: null, project: null }) } } as unknown as PreviewFeed,
    view: new ViewStore(),
    drawing,
    viewer: { seenFrom, pixelLength: 0.01, requestFrame: () => undefined },
  });
  const measured = () => drawing.state.getState().measured;
  const shown = tool.overlay();
  for (const text of ["0,0,0", "@1,0,0"]) expect(tool.take(text)).toBeNull();
  expect(measured()).toHaveLength(2);
  shown.dispose();
  expect([tool.picked, measured().length]).toEqual([0, 0]);
  tool.overlay();
  expect(tool.take("@1,0,0")).toBe("no-last-place");
  expect(tool.take("2,0,0")).toBeNull();
  expect(measured()).toEqual([[2, 0, 0]]);
});

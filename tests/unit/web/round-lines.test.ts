import { LIMITS } from "tetrafront";
import { expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { addParameter, setParameter } from "../../../web/document/parameters";
import { ViewStore } from "../../../web/document/selection";
import { distance } from "../../../web/document/vectors";
import { DocumentStore } from "../../../web/session/document-store";
import type { PreviewFeed } from "../../../web/session/preview";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { LineTool } from "../../../web/tools/drawing/line-tool";
import type { Viewer } from "../../../web/viewer/viewer";

const seenFrom: Viewer["seenFrom"] = (at) => ({
  pointer: at,
  ray: { origin: [at.x / 100, at.y / 100, 10], direction: [0, 0, -1] },
  toScreen: ([x, y]) => ({ x: 100 * x, y: 100 * y }),
});

/** Draws a line of typed places in a project with a parameter r of 2. `inform` receives what the user is told. */
function drawn(
  lineType: "circle" | "arc",
  texts: readonly string[],
  inform: (text: string) => void = () => expect.unreachable(),
): DocumentStore {
  const documents = new DocumentStore(emptyProject(), () => 0);
  documents.edit(addParameter("r", "2"));
  const view = new ViewStore();
  view.state.setState({ lineType });
  const viewer = { seenFrom, pixelLength: 0.01, requestFrame: () => undefined };
  const previews = {
    state: { getState: () => ({ preview: null, project: null }) },
  } as unknown as PreviewFeed;
  const tool = new LineTool({ documents, previews, view, drawing: new Drawing(), viewer, inform });
  for (const text of texts) expect(tool.take(text)).toBeNull();
  expect(documents.project.lines).toHaveLength(1);
  return documents;
}

/** An expression that the file can just hold: its value is that of a shorter one. */
const long = (expression: string): string =>
  expression + "+0".repeat(Math.floor((LIMITS.expression - expression.length) / 2));

it.each([
  ["circle", ["0,0,0", "r"]],
  ["arc", ["0,0,0", "r,0,0", "r"]],
] as const)("a typed %s follows a parameter", (type, texts) => {
  const documents = drawn(type, texts);
  const before = documents.project.points.map(({ position }) => position);
  documents.edit(setParameter("r", "4"));
  documents.project.points.forEach(({ position }, i) =>
    expect(
      distance(position, (before[i] ?? [0, 0, 0]).map((x) => 2 * x) as [number, number, number]),
    ).toBeLessThan(1e-12),
  );
});

it.each([
  ["circle", ["0,0,0", `${long("r")},r/9,0`]],
  ["arc", ["0,0,0", `${long("r")},r/9,0`, "r"]],
] as const)("no point of a drawn %s has expressions if some of them would be too long", (type, texts) => {
  const told: string[] = [];
  const documents = drawn(type, texts, (text) => told.push(text));
  expect(told).toEqual([expect.stringContaining("too long")]);
  expect(documents.project.expressions ?? []).toEqual([]);
  const before = documents.project.points;
  documents.edit(setParameter("r", "4"));
  expect(documents.project.points).toEqual(before);
});

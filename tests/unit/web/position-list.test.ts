import { expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { addPoints, readPositionList, refusedLineOf } from "../../../web/document/position-list";
import { pasteLines } from "../../../web/commands/clipboard-actions";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { DocumentStore } from "../../../web/session/document-store";
import { createShell } from "../../../web/session/shell";

it.each<[string, string, number[][] | null]>([
  ["commas", "1,2,3\n4,5,6", [[1, 2, 3], [4, 5, 6]]], // prettier-ignore
  ["tabs of a spreadsheet, with a heading", "x\ty\tz\r\n0.5\t1e-3\t-2\r\n", [[0.5, 0.001, -2]]],
  ["two numbers, comments and empty lines", "# section\n1 2\n\n// end\n3;4", [[1, 2, 0], [3, 4, 0]]], // prettier-ignore
  ["words", "hello\nworld", null],
  ["four numbers", "1 2 3 4", null],
  ["a line that is no position", "1,2,3\n4,five,6", null],
  ["a project file", '{"format": "tetrafront-project"}', null],
  ["nothing", "  \n", null],
])("reads positions with %s", (_, text, expected) => {
  expect(readPositionList(text)).toEqual(expected);
});

it.each<[string, string | null]>([
  ["1,2,3\n4,five,6", "4,five,6"],
  ["x,y,z\n1 2 3\n\n1e999 0 0\n4 5 6", "1e999 0 0"],
  ["1,2,3\n4,5,6", null],
  ["hello\nworld", null],
  ["", null],
])("names the first line of a list that is no position: %j", (text, expected) => {
  expect(refusedLineOf(text)).toBe(expected);
});

it("adds pasted points as one step", () => {
  const documents = new DocumentStore(emptyProject());
  const positions = readPositionList("0 0 0\n1 0 0\n1 1 0") ?? [];
  const { edit, entities } = addPoints(documents.project, positions);
  documents.edit(edit);
  expect(documents.project.points.map(({ position }) => position)).toEqual(positions);
  expect(entities).toHaveLength(3);
  documents.undo();
  expect(documents.project.points).toEqual([]);
});

it("hands pasted lines to the active tool, up to the first that it refuses", () => {
  const drawing = new Drawing();
  expect(drawing.takeLines("1,2")).toBeUndefined();
  const taken: string[] = [];
  drawing.begin({
    takesCoordinates: true,
    take: (text) => (text === "?" ? "syntax" : (taken.push(text), null)),
  });
  expect(drawing.takeLines("1,2\n@1,0\n")).toBeNull();
  expect(drawing.takeLines("5,5\n?\n6,6")).toBe("?");
  expect(taken).toEqual(["1,2", "@1,0", "5,5"]);
});

it("hands no heading to a tool, but a first line of parameters", () => {
  const drawing = new Drawing();
  const taken: string[] = [];
  const take = (text: string) => (text.startsWith("x") ? "syntax" : (taken.push(text), null));
  drawing.begin({ takesCoordinates: true, take });
  expect(drawing.takeLines("x,y,z\n1,2,3\n")).toBeNull();
  expect(drawing.takeLines("r,0,0\n")).toBeNull();
  expect(taken).toEqual(["1,2,3", "r,0,0"]);
  expect(drawing.takeLines("1,2,3\nx,y,z\n")).toBe("x,y,z");
});

it("leaves coordinates to others if the tool takes none", () => {
  const drawing = new Drawing();
  drawing.begin({ takesCoordinates: false, take: () => "syntax" });
  expect(drawing.takeLines("1,2,3\n4,5,6")).toBeUndefined();
});

it("tells which pasted line a tool has refused", () => {
  const drawing = new Drawing();
  const shell = createShell();
  const paste = (text: string) => pasteLines({ drawing, shell }, text);
  expect(paste("1,2,3")).toBe(false);
  drawing.begin({ takesCoordinates: true, take: (text) => (text === "five" ? "syntax" : null) });
  expect(paste("1,2,3\n4,5,6")).toBe(true);
  expect(shell.getState().message).toBeNull();
  expect(paste("1,2,3\nfive")).toBe(true);
  expect(shell.getState().message?.lines[0]).toContain('"five" is no position');
});

it("adds more points than a call has arguments", () => {
  const positions = Array.from({ length: 200_000 }, (_, x) => [x, 0, 0] as const);
  const project = structuredClone(emptyProject());
  const { edit } = addPoints(project, positions);
  if (!("change" in edit)) throw new Error("The edit has no change");
  edit.change({ project } as Parameters<typeof edit.change>[0]);
  expect(project.points).toHaveLength(positions.length);
});

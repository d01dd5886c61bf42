import { describe, expect, it } from "vitest";
import { searchHelp, sectionsOf } from "../../../web/document/help-search";
import { documentOfFile, documents } from "../../../web/panels/help/documents";

const text = [
  "# Files",
  "What **files** are.",
  "## STL, text or binary",
  "Welding of `points`.",
  "```sh",
  "# not a heading",
  "```",
  "## Units",
  "Millimetres; see [STL](#stl).",
].join("\n");

describe("the sections of a document", () => {
  const sections = sectionsOf("a", text);

  it("begin at headings outside of code, and leave nothing out", () => {
    expect(sections.map(({ title }) => title)).toEqual(["Files", "STL, text or binary", "Units"]);
    expect(sections.map((section) => section.text).join("\n")).toBe(text);
  });

  it("are found by the beginnings of words, titles first", () => {
    const found = (query: string) => searchHelp(query, sections).map(({ section }) => section.title);
    expect(found("stl")).toEqual(["STL, text or binary", "Units"]);
    expect(found("weld poi")).toEqual(["STL, text or binary"]);
    expect(found("MILLI")).toEqual(["Units"]);
    expect(found("illi")).toEqual([]);
    expect(found("  ")).toEqual([]);
  });

  it("show what was found, without the signs of Markdown", () => {
    const [result] = searchHelp("welding", sections);
    expect(result?.excerpt).toContain("Welding of points.");
  });
});

it("links from one document to another open it in the help", () => {
  let links = 0;
  for (const text of Object.values(documents)) {
    for (const [, path = ""] of text.matchAll(/\]\(([\w./-]*\.md)(?:#[^)]*)?\)/g)) {
      // How to change the code is no help in the app.
      if (path.endsWith("CONTRIBUTING.md")) continue;
      ++links;
      expect([path, documentOfFile(path)]).toEqual([path, expect.any(String)]);
    }
  }
  expect(links).toBeGreaterThan(5);
  expect(documentOfFile("LICENSE")).toBeNull();
});

import { describe, expect, it } from "vitest";
import { listSelection, type ListClick } from "../../../web/document/list-selection";

const items = [..."abcdefgh"];
const keys = { anchor: null, range: false, toggle: false };
const click = (selected: string, item: string, more: Partial<Omit<ListClick<string>, "item">>): string =>
  listSelection(items, [...selected], { item, ...keys, ...more }).join("");

describe("a click in a list", () => {
  it("selects the item alone", () => expect(click("abc", "e", {})).toBe("e"));

  it("with Ctrl adds the item, and removes it again", () => {
    expect(click("ab", "e", { toggle: true })).toBe("abe");
    expect(click("abe", "b", { toggle: true })).toBe("ae");
  });

  it("with Shift selects from the anchor, in either direction, and nothing else", () => {
    expect(click("ah", "e", { range: true, anchor: "b" })).toBe("bcde");
    expect(click("ah", "b", { range: true, anchor: "e" })).toBe("edcb");
    expect(click("", "c", { range: true })).toBe("c");
    expect(click("", "c", { range: true, anchor: "gone" })).toBe("c");
  });

  it("with Ctrl and Shift adds the range once", () =>
    expect(click("ca", "d", { range: true, toggle: true, anchor: "b" })).toBe("cabd"));
});

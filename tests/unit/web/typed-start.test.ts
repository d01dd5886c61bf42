/** How coordinates that begin with a letter are typed. */
import { describe, expect, it } from "vitest";
import { isHotkey } from "../../../web/commands/registry";
import { lettersAfter, typedStart } from "../../../web/tools/drawing/typed-start";

const named = new Map([["radius", 1]]);

/** Returns the text in the field after some keys, and the keys that ran commands. */
function typed(keys: string): { readonly text: string | null; readonly commands: string } {
  let text: string | null = null;
  let [letters, run] = ["", ""];
  for (const key of keys) {
    if (text !== null) text += key;
    else {
      text = typedStart(key, { letters, named, isHotkey });
      letters = text === null ? lettersAfter(letters, key) : "";
      if (text === null && isHotkey(key)) run += key;
    }
  }
  return { text, commands: run };
}

describe("typed coordinates", () => {
  it("begin with a digit, a sign, a parenthesis or @, as ever", () => {
    for (const text of ["1,2,0", "-1,2", "(1+2),0,0", "@1,0"]) expect(typed(text).text).toBe(text);
  });

  it("begin with a parameter whose first letter is no hotkey", () => {
    expect(typed("radius,0,0")).toEqual({ text: "radius,0,0", commands: "" });
    expect(typed("k,0,0").text).toBe(",0,0");
  });

  it("begin with any name after =", () => {
    expect(typed("=sin(30),0,0")).toEqual({ text: "sin(30),0,0", commands: "" });
  });

  it("keep a name whose letters were hotkeys", () => {
    expect(typed("pi,2,0").text).toBe("pi,2,0");
    expect(typed("pi-1,2,0").text).toBe("pi-1,2,0");
    expect(typed("sin(30),0,0").text).toBe("sin(30),0,0");
  });

  it("never lose their first number silently", () => {
    expect(typed("xyz,2,0").text).toMatch(/^,/);
    expect(typed("x*2,0,0").text).toMatch(/^\*/);
  });

  it("follow the hotkey of a tool", () => {
    expect(typed("p1,2,0")).toEqual({ text: "1,2,0", commands: "p" });
    expect(typed("l-1,2,0")).toEqual({ text: "-1,2,0", commands: "l" });
  });

  it("are not opened by a comma or operator alone, which have hotkeys", () => {
    expect(typed(",").text).toBeNull();
    expect(typed("<").text).toBeNull();
  });
});

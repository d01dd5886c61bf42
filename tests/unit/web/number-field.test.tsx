// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { act } from "react";
import { describe, expect, it } from "vitest";
import { NumberField, type OwnNumber } from "../../../web/ui/fields/number-field";
import { rootPerTest } from "../../support/react-root";

const render = rootPerTest();

/** A field for the z of points, which differ if there are several. Returns what it commits. */
function fieldOf(values: readonly number[], canStep = true) {
  const commits: (readonly number[])[] = [];
  const changeBy = (change: number) => {
    const changed = values.map((z) => z + change);
    return { values: changed, commit: () => void commits.push(changed) };
  };
  const own: OwnNumber = {
    read: (text) => {
      if (!text.startsWith("z+")) return undefined;
      const change = Number(text.slice(2));
      return Number.isNaN(change) ? null : changeBy(change);
    },
    step: (change) => (canStep ? changeBy(change) : null),
  };
  const onCommit = (value: number): void => void commits.push(values.map(() => value));
  const [first = 0, ...others] = values;
  const value = others.length > 0 ? null : first;
  render(
    <MantineProvider>
      <NumberField label="z" value={value} step={0.5} own={own} onCommit={onCommit} />
    </MantineProvider>,
  );
  const input = document.querySelector("input");
  if (!input) throw new Error("no field");
  const setValue = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value");
  const type = (text: string): void =>
    act(() => {
      setValue?.set?.call(input, text);
      input.dispatchEvent(new Event("input", { bubbles: true }));
    });
  const press = (key: string): void =>
    act(() => void input.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true })));
  const isInvalid = (): boolean => input.getAttribute("aria-invalid") === "true";
  return { commits, type, press, isInvalid };
}

describe("an arrow key in a field whose values differ", () => {
  it.each<readonly [string, readonly string[]]>([
    ["untouched", []],
    ["emptied", ["5", ""]],
    ["with a text that is no number", ["?"]],
  ])("steps each from its own value: %s", (_, texts) => {
    const { commits, type, press } = fieldOf([1, 2]);
    texts.forEach(type);
    press("ArrowUp");
    press("ArrowDown");
    expect(commits).toEqual([
      [1.5, 2.5],
      [0.5, 1.5],
    ]);
  });

  it("commits an expression in terms of own values, without a step", () => {
    const { commits, type, press } = fieldOf([1, 2]);
    type("z+4");
    press("ArrowUp");
    expect(commits).toEqual([[5, 6]]);
  });

  it("steps from a number that was typed", () => {
    const { commits, type, press } = fieldOf([1, 2]);
    type("7");
    press("ArrowDown");
    expect(commits).toEqual([[6.5, 6.5]]);
  });

  it("changes nothing if one of them has no value", () => {
    const { commits, type, press } = fieldOf([1, 2], false);
    press("ArrowUp");
    type("?");
    press("ArrowUp");
    expect(commits).toEqual([]);
  });
});

describe("an arrow key in a field with one value", () => {
  it("steps it", () => {
    const { commits, press } = fieldOf([1]);
    press("ArrowUp");
    expect(commits).toEqual([[1.5]]);
  });

  it("commits an expression in terms of own values, or says why it cannot", () => {
    const { commits, type, press, isInvalid } = fieldOf([1]);
    type("z+?");
    press("ArrowUp");
    expect(commits).toEqual([]);
    expect(isInvalid()).toBe(true);
    type("z+4");
    press("ArrowUp");
    expect(commits).toEqual([[5]]);
    expect(isInvalid()).toBe(false);
  });
});

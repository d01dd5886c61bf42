import { describe, expect, it } from "vitest";
import { differenceOf, reversed, withDifference } from "../../../web/session/difference";
import { randomSource } from "../../support/random";

interface Item {
  readonly id: number;
  readonly position: readonly number[];
  readonly parts?: readonly { readonly id: number; readonly name: string }[];
}

interface State {
  readonly name?: string;
  readonly list: readonly Item[];
  readonly loops: readonly (readonly number[])[];
  readonly inner?: { readonly sizes: readonly number[] };
}

const items = (count: number): Item[] =>
  Array.from({ length: count }, (_, i) => ({ id: i + 1, position: [i, 2 * i, 3 * i] }));

describe("the difference of two states", () => {
  it("leads from one to the other and back, also as JSON, whatever was changed", () => {
    const random = randomSource(5);
    const below = (limit: number): number => random() % limit;
    const anyItem = (): Item => ({
      id: below(30),
      position: [below(3), below(3)],
      ...(below(3) === 0 && { parts: [{ id: below(4), name: `part ${below(3)}` }] }),
    });
    const anyState = (): State => ({
      ...(below(2) === 0 && { name: `name ${below(3)}` }),
      list: Array.from({ length: below(12) }, anyItem),
      loops: Array.from({ length: below(4) }, () => [below(3), below(3)]),
      ...(below(2) === 0 && { inner: { sizes: [below(2), below(2)] } }),
    });
    /** A state that shares many records with another one: some are removed, changed, added or moved. */
    const near = (state: State): State => {
      const list = state.list.filter(() => below(5) > 0).map((item) => (below(4) > 0 ? item : anyItem()));
      list.splice(below(list.length + 1), 0, ...Array.from({ length: below(3) }, anyItem));
      if (below(4) === 0) list.reverse();
      return { ...anyState(), list };
    };
    for (let i = 0; i < 5000; ++i) {
      const before = anyState();
      const after = i % 2 === 0 ? near(before) : anyState();
      const difference = differenceOf(before, after);
      if (!difference) {
        expect(after).toEqual(before);
        continue;
      }
      const stored = JSON.parse(JSON.stringify(difference)) as typeof difference;
      for (const one of [difference, stored]) {
        expect(withDifference(before, one)).toEqual(after);
        expect(withDifference(after, reversed(one))).toEqual(before);
      }
    }
  });

  it("holds the changed records only, wherever they are", () => {
    const list = items(1000);
    const [first, second] = [
      { id: 11, position: [7, 7, 7] },
      { id: 801, position: [8, 8, 8] },
    ];
    const changed = list.with(10, first).with(800, second);
    expect(differenceOf({ list }, { list: changed })).toEqual({
      fields: {
        list: {
          list: [
            [10, [list[10]], [first]],
            [789, [list[800]], [second]],
          ],
        },
      },
    });
    const without = list.filter(({ id }) => id !== 300 && id !== 700);
    expect(differenceOf(list, without)).toEqual({
      list: [
        [299, [list[299]], []],
        [399, [list[699]], []],
      ],
    });
    const added = [...list, ...items(1002).slice(1000)];
    expect(differenceOf(list, added)).toEqual({ list: [[1000, [], added.slice(1000)]] });
  });

  it("of a record that holds others is that of its fields", () => {
    const parts = Array.from({ length: 100 }, (_, i) => ({ id: i, name: `part ${i}` }));
    const body = { id: 1, position: [0], parts };
    const moved = { ...body, position: [1] };
    expect(differenceOf([body], [moved])).toEqual({
      list: [[0, { fields: { position: { from: [0], to: [1] } } }]],
    });
  });

  it("of a list of references holds those that are added and removed", () => {
    const kinds = ["point", "line", "patch"];
    const members = Array.from({ length: 300 }, (_, i) => ({ kind: kinds[i % 3], id: Math.floor(i / 3) }));
    const rest = members.filter((_, i) => i !== 30 && i !== 200);
    expect(differenceOf({ members }, { members: rest })).toEqual({
      fields: {
        members: {
          list: [
            [30, [members[30]], []],
            [169, [members[200]], []],
          ],
        },
      },
    });
  });

  it("is nothing if only the objects differ", () => {
    expect(differenceOf({ list: items(3), name: "a" }, { list: items(3), name: "a" })).toBeUndefined();
  });

  it("shares unchanged records with the state, and new ones with the difference", () => {
    const list = items(5);
    const changed = list.with(2, { id: 3, position: [9] });
    const difference = differenceOf(list, changed);
    const after = difference ? withDifference(list, difference) : [];
    for (const i of list.keys()) expect(after[i]).toBe(changed[i]);
  });
});

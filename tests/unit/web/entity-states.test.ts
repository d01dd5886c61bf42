import { BufferGeometry } from "three";
import { describe, expect, it } from "vitest";
import { stateCodes } from "../../../web/viewer/draw-state";
import { EntityStates, offsetsOf } from "../../../web/viewer/entity-states";
import type { SceneState } from "../../../web/viewer/scene-state";

type Emphasis = Pick<SceneState, "selection" | "hover" | "hidden" | "defects" | "tints">;

const { hidden, normal, hover, selected, defective } = stateCodes;
const nothing: Emphasis = {
  selection: [],
  hover: null,
  hidden: new Set(),
  defects: {
    triangles: [],
    patches: new Set(),
    openLines: new Set<number>(),
    areOpenLinesExpected: false,
    bodies: new Map(),
  },
  tints: new Map(),
};
/** Ids that are not indices, with one, two and three vertices. */
const patches = [{ id: 7 }, { id: 3 }, { id: 12 }];
const offsets = [0, 1, 3, 6];

function shown(emphasis: Partial<Emphasis> = {}): EntityStates {
  const states = new EntityStates("patch");
  states.assign(patches, offsets);
  states.update({ ...nothing, ...emphasis });
  return states;
}

const bytes = (states: EntityStates): number[] => [...states.attribute.array];
const patch = (id: number) => ({ kind: "patch", id }) as const;

describe("EntityStates", () => {
  it("gives the vertices of grouped entities the colour of their group, and takes it back", () => {
    const states = new EntityStates("patch", { tinted: true });
    const geometry = new BufferGeometry();
    states.assign(patches, offsets);
    states.attachTo(geometry);
    const tints = () => [...geometry.getAttribute("tint").array];
    const plain = [255, 255, 255, 255];
    states.update({
      ...nothing,
      tints: new Map([
        ["patch-3", [1, 0, 0.2]],
        ["line-7", [0, 0, 0]],
      ]),
    });
    expect(tints()).toEqual([plain, [255, 0, 51, 0], [255, 0, 51, 0], plain, plain, plain].flat());
    states.update(nothing);
    expect(tints()).toEqual(Array.from({ length: 6 }, () => plain).flat());
  });

  it("gives every vertex the state of its entity", () => {
    const states = shown({
      selection: [patch(12), { kind: "line", id: 7 }],
      hover: patch(3),
      hidden: new Set(["patch-7", "point-3"]),
    });
    expect(bytes(states)).toEqual([hidden, hover, hover, selected, selected, selected]);
    expect(states.hasAny("normal", "defective")).toBe(false);
    expect(states.hasAny("hover")).toBe(true);
  });

  it("prefers hidden to selected, selected to hover, and hover to defective", () => {
    const defects = {
      triangles: [],
      patches: new Set([3, 7, 12]),
      openLines: new Set<number>(),
      areOpenLinesExpected: false,
      bodies: new Map(),
    };
    const states = shown({
      defects,
      hidden: new Set(["patch-7"]),
      selection: [patch(7), patch(3)],
      hover: patch(3),
    });
    expect(bytes(states)).toEqual([hidden, selected, selected, defective, defective, defective]);
  });

  it("writes only the bytes of entities whose state changes", () => {
    const states = shown();
    const { attribute } = states;
    attribute.clearUpdateRanges();
    const before = { ...nothing, hover: patch(3) };
    states.update(before);
    expect(attribute.updateRanges).toEqual([{ start: 1, count: 2 }]);
    attribute.clearUpdateRanges();
    states.update({ ...before, hover: patch(12) });
    expect(attribute.updateRanges).toEqual([
      { start: 1, count: 2 },
      { start: 3, count: 3 },
    ]);
    expect(bytes(states)).toEqual([normal, normal, normal, hover, hover, hover]);
    expect(states.attribute).toBe(attribute);
  });

  it("writes nothing for an entity that has another kind or does not exist", () => {
    const states = shown();
    states.attribute.clearUpdateRanges();
    states.update({ ...nothing, hover: { kind: "line", id: 3 }, selection: [patch(99)] });
    expect(states.attribute.updateRanges).toEqual([]);
  });

  it("keeps the buffer if new records have the same entities", () => {
    const states = shown({ selection: [patch(3)] });
    const { attribute } = states;
    attribute.clearUpdateRanges();
    states.assign(
      patches.map(({ id }) => ({ id })),
      [...offsets],
    );
    states.update({ ...nothing, selection: [patch(3)] });
    expect(states.attribute).toBe(attribute);
    expect(bytes(states)).toEqual([normal, selected, selected, normal, normal, normal]);
    expect(attribute.updateRanges).toEqual([]);
  });

  it("writes all states again if other entities take over the vertices", () => {
    const states = shown({ selection: [patch(3)] });
    states.assign([{ id: 1 }, { id: 2 }, { id: 3 }], offsets);
    states.update({ ...nothing, selection: [patch(3)] });
    expect(bytes(states)).toEqual([normal, normal, normal, selected, selected, selected]);
    states.assign([{ id: 3 }], [0, 2]);
    states.update({ ...nothing, selection: [patch(3)] });
    expect(bytes(states)).toEqual([selected, selected]);
  });

  it("finds the entity of a vertex", () => {
    const states = shown();
    expect([0, 1, 2, 3, 4, 5].map((vertex) => states.entityAt(states.recordOf(vertex))?.id)).toEqual([
      7, 3, 3, 12, 12, 12,
    ]);
    expect(states.firstVertexOf(1)).toBe(1);
  });

  it("skips entities without vertices", () => {
    const states = new EntityStates("line");
    const lines = [
      { id: 1, n: 0 },
      { id: 2, n: 2 },
      { id: 3, n: 0 },
      { id: 4, n: 1 },
    ];
    states.assign(
      lines,
      offsetsOf(lines, ({ n }) => n),
    );
    states.update(nothing);
    expect([0, 1, 2].map((vertex) => states.recordOf(vertex))).toEqual([1, 1, 3]);
  });
});

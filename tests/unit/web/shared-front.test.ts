/** Addresses of states of a front. */
import { expect, it } from "vitest";
import {
  queryOf,
  sharedFrontIn,
  withoutFront,
  type SharedFront,
} from "../../../web/teach/player/shared-front";

const full: SharedFront = {
  model: "unit-cube",
  step: 258,
  order: "smallest-first",
  coloring: "layer",
  faces: "all",
  elements: "all",
  candidate: 1,
  beat: 2,
  camera: { eye: [3, -2, 1.5], target: [0.5, 0.25, 1e-7] },
};

it("are read as they were written, and leave out defaults", () => {
  expect(sharedFrontIn(queryOf(full))).toEqual(full);
  const usual = { order: null, coloring: "age", faces: "inside", elements: "recent" } as const;
  const plain: SharedFront = { ...full, ...usual, candidate: null, beat: null, camera: null };
  expect(queryOf(plain).toString()).toBe("model=unit-cube&step=258");
  expect(sharedFrontIn(queryOf(plain))).toEqual(plain);
});

it("name nothing without a model and a step", () => {
  for (const query of [
    "",
    "model=unit-cube",
    "step=3",
    "model=a&step=--1",
    "model=a&step=x",
    "model=a&step=1.5",
  ])
    expect(sharedFrontIn(new URLSearchParams(query)), query).toBeNull();
});

it.each([
  ["order=largest", { order: null }],
  ["color=red", { coloring: "age" }],
  ["faces=half", { faces: "inside" }],
  ["elements=some", { elements: "recent" }],
  ["candidate=-1", { candidate: null }],
  ["beat=0", { beat: null }],
  ["beat=-1", { beat: null }],
  ["beat=x", { beat: null }],
  ["camera=1,2,3", { camera: null }],
  ["camera=1,2,3,4,5,x", { camera: null }],
  ["camera=1,2,,4,5,6", { camera: null }],
  ["camera=1,2,3,1,2,3", { camera: null }],
  ["camera=1e999,2,3,1,2,3", { camera: null }],
])("ignore %s, which means nothing", (query, expected) => {
  expect(sharedFrontIn(new URLSearchParams(`model=a&step=1&${query}`))).toMatchObject(expected);
});

it("lose the front and keep the rest when another document is opened", () => {
  const address = withoutFront(`https://example.org/app/?test=1&${queryOf(full).toString()}#top`);
  expect(address.href).toBe("https://example.org/app/?test=1&model=unit-cube#top");
  expect(sharedFrontIn(address.searchParams)).toBeNull();
});

import { expect, it } from "vitest";
import { KeptMeshes } from "../../../web/session/kept-meshes";
import type { ShownMesh } from "../../../web/session/shown-mesh";

/** A mesh for tests that only ask whether a run has made it. */
const shown = (isValid: boolean | null): ShownMesh =>
  ({ edgeReference: "mean", origin: null, improvement: null, isValid }) as unknown as ShownMesh;
const byRun = shown(null);
const fromFile = shown(true);

const keysIn = (kept: KeptMeshes, keys: readonly string[]): string =>
  keys.filter((key) => kept.show(key) !== undefined).join("");

it("a run's mesh is kept, however many meshes of earlier documents no run can make again", () => {
  const kept = new KeptMeshes("0");
  for (let k = 0; k < 6; k++) {
    kept.open(`${k + 1}`, `${k}`);
    kept.add(`file ${k}`, fromFile);
  }
  kept.open("present", "6");
  for (const key of "abcd") kept.add(key, byRun);
  expect(keysIn(kept, [..."abcd"])).toBe("abcd");
});

it("the newest mesh is never dropped", () => {
  const kept = new KeptMeshes("present");
  for (const key of "abcdef") kept.add(key, fromFile);
  kept.add("g", byRun);
  expect(keysIn(kept, [..."abcdefg"])).toBe("bcdefg");
});

it("a document that is opened again shows its meshes, also those that a run has made", () => {
  const kept = new KeptMeshes("first");
  kept.add("a", byRun);
  kept.add("b", fromFile);
  kept.open("second", "first");
  for (const key of "cdef") kept.add(key, byRun);
  kept.open("first", "second");
  expect(keysIn(kept, ["a", "b"])).toBe("ab");
});

it("a mesh belongs to the document that has shown it last", () => {
  const kept = new KeptMeshes("first");
  // As it is opened: kept before its document takes the place of the first one.
  kept.add("opened", fromFile);
  kept.open("second", "first");
  expect(kept.show("opened")).toBeDefined();
  kept.open("third", "second");
  for (const key of "abcdefgh") kept.add(key, byRun);
  expect(keysIn(kept, ["opened", ..."abcdefgh"])).toBe("openeddefgh");
});

/** Numbers of elements that are asked for, from cycle to cycle. */
import { correctedNumber } from "tetrafront/internal";
import { expect, test } from "vitest";

const meshOf = (elements: number) => ({ tetrahedra: new Uint32Array(4 * elements) });

test("a mesh with more or fewer elements than asked for makes the next number smaller or larger by the same factor", () => {
  expect(correctedNumber(1100, meshOf(1100), 1000)).toBe(1000);
  expect(correctedNumber(3000, meshOf(1800), 2000)).toBe(3333);
});

test("the wanted number stays where nothing was asked for, and as it is where a mesh agreed", () => {
  expect(correctedNumber(3000, meshOf(1800), undefined)).toBe(3000);
  expect(correctedNumber(undefined, meshOf(1800), 2000)).toBeUndefined();
  expect(correctedNumber(3000, meshOf(2000), 2000)).toBe(3000);
});

test("a number is corrected by a factor of two at most, and never to zero", () => {
  expect(correctedNumber(3000, meshOf(90000), 1000)).toBe(1500);
  expect(correctedNumber(3000, meshOf(1), 1000)).toBe(6000);
  expect(correctedNumber(1, meshOf(100), 0)).toBe(1);
});

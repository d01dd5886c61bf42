import { readOff, readProject, readStl, writeProject } from "tetrafront";
import { describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { offFile, stlBinary, stlText } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

/** A small generator of whole numbers below 2^32, the same on every machine (Marsaglia's xorshift). */
function randomSource(seed: number): () => number {
  let state = seed;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return state >>> 0;
  };
}

/** Some bytes changed, a piece cut out, or a piece repeated. */
function mutated(file: Uint8Array, random: () => number): Uint8Array {
  const at = random() % file.length;
  const length = random() % 40;
  switch (random() % 3) {
    case 0:
      return file.map((byte) => (random() % 50 === 0 ? random() & 255 : byte));
    case 1:
      return Uint8Array.of(...file.subarray(0, at), ...file.subarray(at + length));
    default:
      return Uint8Array.of(...file.subarray(0, at + length), ...file.subarray(at));
  }
}

const text = new TextDecoder();
const cube = boxSurface(2);

describe.each<[string, Uint8Array, (bytes: Uint8Array) => ReturnType<typeof readStl>]>([
  ["text STL", stlText(cube), readStl],
  ["binary STL", stlBinary(cube), readStl],
  ["OFF", offFile(cube), readOff],
])("damaged %s files, seeds 1 to 300,", (_, file, read) => {
  test("give a surface that holds together or a problem with a remedy", () => {
    for (let seed = 1; seed <= 300; seed++) {
      const result = read(mutated(file, randomSource(seed)));
      if (result.success) {
        const { points, triangles } = result.value;
        expect([points.length % 3, triangles.length % 3]).toEqual([0, 0]);
        expect(triangles.every((node) => node < points.length / 3)).toBe(true);
      } else {
        expect(result.problems[0].message, `seed ${seed}`).toMatch(/\S/);
        expect(result.problems[0].remedy, `seed ${seed}`).toMatch(/\.$/);
      }
    }
  });
});

test("damaged projects, seeds 1 to 300, are read or refused with a remedy", () => {
  const file = new TextEncoder().encode(writeProject(cubeProject()));
  let refused = 0;
  for (let seed = 1; seed <= 300; seed++) {
    const result = readProject(text.decode(mutated(file, randomSource(seed))));
    if (result.success) continue;
    refused++;
    for (const { message, remedy } of result.problems) {
      expect(message, `seed ${seed}`).toMatch(/\S/);
      expect(remedy, `seed ${seed}`).toMatch(/\.$/);
    }
  }
  expect(refused).toBeGreaterThan(200);
});

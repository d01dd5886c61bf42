/** Solids of an STL file inside others, next to solids that touch or overlap: each keeps its name and its volume. */
import { meshFile, type MeshFileOptions, type SurfaceInput } from "tetrafront";
import { describe, expect, test } from "vitest";

import { enclosedVolume } from "../../support/check-mesh.js";
import { stlText } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";

type Parts = Readonly<Record<string, SurfaceInput>>;

const stlOf = (parts: Parts): Uint8Array =>
  Buffer.concat(Object.entries(parts).map(([name, part]) => stlText(part, name)));

async function meshed(parts: Parts, options: MeshFileOptions = {}) {
  const made = await meshFile(stlOf(parts), { fileName: "solids.stl", ...options });
  if (!made.success) throw new Error(made.message);
  const volumes = Object.fromEntries(made.report.regions.map(({ name, volume }) => [name, volume]));
  return { volumes, notes: made.notes.join("\n"), warnings: warningsOf(made.report.diagnostics) };
}

const warningsOf = (all: readonly { readonly severity: string }[]) =>
  all.filter(({ severity }) => severity === "warning");

const near = (volume: number) => expect.closeTo(volume, 6) as number;

const matrix = boxSurface(2, [0, 0, 0], [4, 4, 4]);
const ball = sphereSurface(6, 1, [2, 2, 2]);
const neighbour = boxSurface(2, [4, 0, 0], [8, 4, 4]);
const crossing = boxSurface(1, [3.5, 1, 1], [5.5, 2, 2]);

describe("a solid inside another one", () => {
  test.each([
    ["touches", { matrix, ball, neighbour }],
    ["overlaps", { matrix, ball, crossing }],
  ] as const)("keeps its name if the outer one %s a third", async (_, parts) => {
    const { volumes, notes } = await meshed(parts);
    expect(Object.keys(volumes).sort()).toEqual(Object.keys(parts).sort());
    expect(volumes["ball"]).toBeGreaterThan(3.5);
    expect((volumes["matrix"] ?? 0) + (volumes["ball"] ?? 0)).toBeCloseTo(64, 6);
    expect(notes).not.toContain("not meshed");
    expect(notes).toContain("3 solids; shared faces");
  });

  test.each(["plug", "matrix"])(
    "and flush with its face is a region, with a note alone; %s first",
    async (first) => {
      const plug = boxSurface(1, [1, 1, 0], [3, 3, 2]);
      const parts: Parts = first === "plug" ? { plug, matrix } : { matrix, plug };
      const { volumes, notes, warnings } = await meshed(parts);
      expect(volumes).toEqual({ matrix: near(56), plug: near(8) });
      expect(warnings).toEqual([]);
      expect(notes).toContain('The solid "plug" lies inside "matrix"');
    },
  );

  test("and another one in it, flush with the same face, are three regions", async () => {
    const outer = boxSurface(1, [1, 1, 0], [3, 3, 2]);
    const inner = boxSurface(1, [1.5, 1.5, 0], [2.5, 2.5, 1]);
    const { volumes } = await meshed({ matrix: boxSurface(1, [0, 0, 0], [4, 4, 4]), outer, inner });
    expect(volumes).toEqual({ matrix: near(56), outer: near(7), inner: near(1) });
  });

  test("bounds a cavity if inner shells do; solids that touch stay regions", async () => {
    const { volumes } = await meshed({ matrix, ball, neighbour }, { innerShells: "cavities" });
    expect(volumes).toEqual({
      matrix: expect.closeTo(64 - enclosedVolume(ball), 4) as number,
      neighbour: near(64),
    });
  });
});

describe("solids", () => {
  test.each([
    ["an edge", [1, 1, 0]],
    ["a node", [1, 1, 1]],
  ] as const)("that touch in %s alone keep their names", async (_, [x, y, z]) => {
    const { volumes } = await meshed({
      a: boxSurface(1),
      b: boxSurface(1, [x, y, z], [x + 1, y + 1, z + 1]),
    });
    expect(volumes).toEqual({ a: near(1), b: near(1) });
  });

  test.each([
    ["touch", boxSurface(2, [1, 0, 0], [2, 1, 1]), 'shared faces: "a" and "b"'],
    ["overlap", boxSurface(2, [0.5, 0, 0], [1.5, 1, 1]), "that touch or overlap do not fit together"],
    ["are equal", boxSurface(2), "that touch or overlap do not fit together"],
  ] as const)("that %s are named so in a note", async (_, b, note) => {
    expect((await meshed({ a: boxSurface(2), b })).notes).toContain(note);
  });

  test("that touch say which share faces, also beside others", async () => {
    const parts = {
      a: boxSurface(1),
      b: boxSurface(1, [1, 0, 0], [2, 1, 1]),
      c: boxSurface(1, [5, 0, 0], [6, 1, 1]),
    };
    expect((await meshed(parts)).notes).toContain('3 solids; shared faces: "a" and "b"');
  });
});

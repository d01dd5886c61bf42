import { NO_REGION } from "tetrafront";
import { expect, test } from "vitest";
import { hasInnerSolid } from "../../../web/document/inner-solids";
import { boxSurface } from "../../support/surfaces.js";

type Surface = ReturnType<typeof boxSurface>;

function scaled({ points, triangles }: Surface, factor: number, isInsideOut = false): Surface {
  return {
    points: points.map((x, i) => factor * (x - middle(points, i % 3))),
    triangles: isInsideOut ? triangles.slice().reverse() : triangles,
  };
}

function middle(points: Float64Array, axis: number): number {
  const own = points.filter((_, i) => i % 3 === axis);
  return (Math.min(...own) + Math.max(...own)) / 2;
}

function joined(one: Surface, other: Surface): Surface {
  const nodes = one.points.length / 3;
  return {
    points: Float64Array.of(...one.points, ...other.points),
    triangles: Uint32Array.of(...one.triangles, ...other.triangles.map((node) => node + nodes)),
  };
}

const box = boxSurface(2);
const large = scaled(box, 4);
const small = scaled(box, 1);
const hollow = joined(large, scaled(box, 2, true));

test("a solid in the material of another makes inner shells regions", () => {
  expect(hasInnerSolid([large, small], undefined)).toBe(true);
  expect(hasInnerSolid([small, large], undefined)).toBe(true);
});

test("a solid in a void of another leaves voids empty", () => {
  expect(hasInnerSolid([hollow, small], undefined)).toBe(false);
  expect(hasInnerSolid([hollow], undefined)).toBe(false);
});

test("a solid beside another leaves voids empty", () => {
  const moved = { ...small, points: small.points.map((x, i) => (i % 3 === 0 ? x + 9 : x)) };
  expect(hasInnerSolid([large, moved], undefined)).toBe(false);
});

test("a solid that shares all its faces with another makes inner shells regions", () => {
  const regions = [
    { name: "shell", tag: 1 },
    { name: "core", tag: 2 },
  ];
  const around = Uint32Array.of(0, NO_REGION, 0, NO_REGION, 1, 0, 1, 0);
  expect(hasInnerSolid([hollow], { regions, triangleRegions: around })).toBe(true);
  const beside = Uint32Array.of(0, NO_REGION, 1, 0, 1, NO_REGION);
  expect(hasInnerSolid([hollow], { regions, triangleRegions: beside })).toBe(false);
});

import { describe, expect, it } from "vitest";
import type { ProjectLine } from "tetrafront/project";
import type { LinePath } from "../../../web/document/line-paths";
import { firstLoop, freeLoops } from "../../../web/document/loop-hits";
import { drawnLoops, keyOf } from "../../../web/document/loop-search";
import { emptyProject } from "../../../web/document/create";
import type { Position } from "../../../web/document/position";
import { randomSource } from "../../support/random";
import { cubeProject } from "../../support/projects";
import { linePaths } from "../../../web/document/line-paths";

/** Straight lines between points given by their positions. */
function straight(positions: readonly Position[], pairs: readonly (readonly [number, number])[]): LinePath[] {
  return pairs.map(([a, b], index) => {
    const line: ProjectLine = { id: index + 1, type: "straight", points: [a, b] };
    return { line, positions: [positions[a] ?? [0, 0, 0], positions[b] ?? [0, 0, 0]] };
  });
}

const keys = (paths: readonly LinePath[]): string[] =>
  drawnLoops(paths)
    .map(({ lines }) => keyOf(lines))
    .toSorted();

/** A grid of squares in the plane z = 0, of which some lines are left out. */
function gridLines(size: number, keep: (index: number) => boolean) {
  const positions: Position[] = [];
  const pairs: [number, number][] = [];
  for (let y = 0; y <= size; ++y) for (let x = 0; x <= size; ++x) positions.push([x, y, 0]);
  const at = (x: number, y: number): number => y * (size + 1) + x;
  for (let y = 0; y <= size; ++y) for (let x = 0; x < size; ++x) pairs.push([at(x, y), at(x + 1, y)]);
  for (let y = 0; y < size; ++y) for (let x = 0; x <= size; ++x) pairs.push([at(x, y), at(x, y + 1)]);
  const all = straight(positions, pairs);
  return all.filter((_, index) => keep(index));
}

/** The squares of a grid that lines do not separate, by flooding from each square: an oracle without angles. */
function floodedAreas(paths: readonly LinePath[], size: number): number[] {
  const walls = new Set(
    paths.map(({ positions: [a = [0, 0, 0], b = [0, 0, 0]] }) => `${(a[0] + b[0]) / 2} ${(a[1] + b[1]) / 2}`),
  );
  const areas: number[] = [];
  const seen = new Set<string>();
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      const stack: (readonly [number, number])[] = [[x, y]];
      let [area, leaks] = [0, false];
      while (stack.length > 0) {
        const [cx, cy] = stack.pop() ?? [0, 0];
        if (cx < 0 || cy < 0 || cx >= size || cy >= size) {
          leaks = true;
          continue;
        }
        if (seen.has(`${cx} ${cy}`)) continue;
        seen.add(`${cx} ${cy}`);
        ++area;
        for (const [dx, dy] of [
          [1, 0],
          [-1, 0],
          [0, 1],
          [0, -1],
        ] as const) {
          // prettier-ignore
          if (!walls.has(`${cx + 0.5 + dx / 2} ${cy + 0.5 + dy / 2}`)) stack.push([cx + dx, cy + dy]);
        }
      }
      if (area > 0 && !leaks) areas.push(area);
    }
  }
  return areas.toSorted((a, b) => a - b);
}

const areaOf = (polygon: readonly Position[]): number =>
  Math.abs(
    polygon.reduce((sum, [x, y], i) => {
      const [nx, ny] = polygon[(i + 1) % polygon.length] ?? [x, y];
      return sum + (x * ny - y * nx) / 2;
    }, 0),
  );

describe("drawnLoops", () => {
  it.each([1, 2, 3, 4, 5, 6])(
    "finds the areas that flooding finds, in a grid with random gaps (seed %i)",
    (seed) => {
      const random = randomSource(seed);
      const size = 6;
      const paths = gridLines(size, () => random() % 5 > 0);
      const planar = drawnLoops(paths).filter(({ normal }) => normal !== null);
      const areas = planar.map(({ polygon, holePolygons }) =>
        Math.round(areaOf(polygon) - holePolygons.reduce((sum, hole) => sum + areaOf(hole), 0)),
      );
      expect(areas.toSorted((a, b) => a - b)).toEqual(floodedAreas(paths, size));
    },
  );

  it("finds the six sides of a cube", () => {
    const project = cubeProject();
    const expected = project.patches.map(({ loops: [outer = []] }) => keyOf(outer)).toSorted();
    expect(keys(linePaths(project, null))).toEqual(expected);
  });

  it("finds loops of three and four lines that lie in no plane", () => {
    const corners: Position[] = [[0, 0, 0], [1, 0, 1], [1, 1, 0], [0, 1, 1]]; // prettier-ignore
    expect(keys(straight(corners, [[0, 1], [1, 2], [2, 3], [3, 0]]))).toEqual(["1,2,3,4"]); // prettier-ignore
    // A diagonal divides the loop into two triangles, each with a plane of its own.
    expect(keys(straight(corners, [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]))).toEqual(["1,2,5", "3,4,5"]); // prettier-ignore
  });

  it("finds a closed line and a loop of two lines", () => {
    const circle: Position[] = Array.from({ length: 33 }, (_, i) => [
      Math.cos((i * Math.PI) / 16),
      Math.sin((i * Math.PI) / 16),
      2,
    ]);
    const closed: LinePath = { line: { id: 9, type: "spline", points: [1, 2, 3, 1] }, positions: circle };
    expect(keys([closed])).toEqual(["9"]);
    const half = (id: number, sign: number): LinePath => ({
      line: { id, type: "parabolic", points: [1, id + 10, 2] },
      positions: [[0, 0, 0], [1, sign, 0], [2, 0, 0]], // prettier-ignore
    });
    expect(keys([half(1, 1), half(2, -1)])).toEqual(["1,2"]);
  });

  it("ignores lines that end nowhere and lines between loops", () => {
    const squares: Position[] = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [1, 1, 0], [2, 1, 0], [2, 2, 0], [1, 2, 0], [9, 9, 0]]; // prettier-ignore
    const paths = straight(squares, [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [2, 8]]); // prettier-ignore
    const planar = drawnLoops(paths).filter(({ normal }) => normal);
    expect(planar.map(({ lines }) => keyOf(lines)).toSorted()).toEqual(["1,2,3,4", "5,6,7,8"]);
    expect(
      planar.find(({ lines }) => lines.length === 4 && lines.map(Math.abs).includes(1))?.holes.map(keyOf),
    ).toEqual(["5,6,7,8"]);
  });

  it("searches 2000 lines", () => {
    const paths = gridLines(31, () => true);
    expect(paths.length).toBeGreaterThan(1900);
    expect(drawnLoops(paths)).toHaveLength(31 * 31);
  });
});

describe("firstLoop and freeLoops", () => {
  const project = cubeProject();
  const loops = drawnLoops(linePaths(project, null));
  const down = { origin: [0.5, 0.5, 9] as Position, direction: [0, 0, -1] as Position };

  it("return the loop nearest to the eye, without those that patches fill", () => {
    const drawn = { ...project, patches: [] };
    const top = firstLoop(
      freeLoops(drawn, loops).map(({ loop }) => loop),
      down,
    );
    expect(top?.polygon.every(([, , z]) => z === 1)).toBe(true);
    const [filled] = project.patches.filter(
      ({ loops: [outer = []] }) => keyOf(outer) === keyOf(top?.lines ?? []),
    );
    const covered = { ...project, patches: filled ? [filled] : [] };
    const next = firstLoop(
      freeLoops(covered, loops).map(({ loop }) => loop),
      down,
    );
    expect(next?.polygon.every(([, , z]) => z === 0)).toBe(true);
    expect(freeLoops(project, loops)).toEqual([]);
  });

  it("make a loop inside a planar patch its hole first, and a patch of its own then", () => {
    const squares: Position[] = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [1, 1, 0], [2, 1, 0], [2, 2, 0], [1, 2, 0]]; // prettier-ignore
    const nested = drawnLoops(straight(squares, [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]])); // prettier-ignore
    const plate = { id: 1, type: "planar", loops: [[1, 2, 3, 4]] } as const;
    const whole = { ...emptyProject(), patches: [plate] };
    expect(freeLoops(whole, nested)).toMatchObject([{ kind: "hole", patch: 1 }]);
    const pierced = { ...whole, patches: [{ ...plate, loops: [[1, 2, 3, 4], [5, 6, 7, 8]] }] }; // prettier-ignore
    expect(freeLoops(pierced, nested)).toMatchObject([{ kind: "patch" }]);
  });
});

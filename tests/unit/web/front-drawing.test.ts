/** Drawings of the front: which faces they show, and in which order. */
import { expect, it } from "vitest";
import { readTrace, type Trace } from "tetrafront";
import { frontDrawing, type DrawingView } from "../../../web/player/front-drawing";
import { cornersOf } from "../../../web/player/judge";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

const { bytes } = starTrace({
  ...starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1])),
  postponeEvery: 6,
  reopenAfter: 20,
});

function readStar(): Trace {
  const read = readTrace(bytes);
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const trace = readStar();

/** Looks from far away along -z, in parallel. */
const fromAbove: DrawingView = {
  width: 200,
  height: 100,
  eye: [0, 0, 1000],
  toScreen: ([x, y]) => ({ x: 100 + 40 * x, y: 50 - 40 * y }),
};

const alone = { scene: null, fades: true } as const;

const polygonsIn = (drawing: string): readonly string[] =>
  [...drawing.matchAll(/<polygon points="([^"]*)" fill="#/g)].map(([, points = ""]) => points);

it("show every face of the front once, or those that look at the eye", () => {
  const all = frontDrawing(trace, { step: 0, coloring: "size", faces: "all", ...alone }, fromAbove);
  expect(polygonsIn(all)).toHaveLength(trace.frontAt(0).length);
  const inside = polygonsIn(
    frontDrawing(trace, { step: 0, coloring: "size", faces: "inside", ...alone }, fromAbove),
  );
  // From inside, the bottom of the box looks up; its top looks down, and its walls are seen from the side.
  const bottom = Array.from(trace.frontAt(0)).filter((face) =>
    cornersOf(trace, face).every(([, , z]) => z === -1),
  );
  expect(bottom.length).toBeGreaterThan(0);
  expect(inside.length).toBeGreaterThanOrEqual(bottom.length);
  expect(inside.length).toBeLessThan(polygonsIn(all).length);
});

it("begin with what is far, and outline the base face of the step", () => {
  const drawing = frontDrawing(trace, { step: 0, coloring: "age", faces: "all", ...alone }, fromAbove);
  const top = Array.from(trace.frontAt(0)).filter((face) =>
    cornersOf(trace, face).every(([, , z]) => z === 1),
  );
  const points = (face: number): string =>
    cornersOf(trace, face)
      .map(([x, y]) => `${(100 + 40 * x).toFixed(2)},${(50 - 40 * y).toFixed(2)}`)
      .join(" ");
  expect(new Set(polygonsIn(drawing).slice(-top.length))).toEqual(new Set(top.map(points)));
  expect(drawing).not.toContain('stroke-width="2"');
  const first = trace.stepAt(1);
  const later = frontDrawing(trace, { step: 1, coloring: "age", faces: "all", ...alone }, fromAbove);
  expect(first?.kind === "advance" && later).toContain(
    `<polygon points="${points(first?.kind === "advance" ? first.face : 0)}" fill="none"`,
  );
});

it("leave out what is out of view, and are well formed", () => {
  const half: DrawingView = {
    ...fromAbove,
    toScreen: (position) => (position[0] > 0 ? null : fromAbove.toScreen(position)),
  };
  const drawing = frontDrawing(trace, { step: 3, coloring: "layer", faces: "all", ...alone }, half);
  expect(polygonsIn(drawing).length).toBeLessThan(trace.frontAt(3).length);
  expect(drawing).toMatch(/^<svg xmlns="http:\/\/www.w3.org\/2000\/svg" viewBox="0 0 200 100"/);
  expect(drawing).not.toMatch(/NaN|undefined|null/);
  expect(drawing.match(/<g /g)).toHaveLength(1);
  expect(drawing.trimEnd().endsWith("</svg>")).toBe(true);
});

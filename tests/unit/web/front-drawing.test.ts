/** Drawings of the front: which faces they show, and in which order. */
import { expect, it } from "vitest";
import { readTrace, type Trace } from "tetrafront/trace";
import { frontDrawing, type DrawingView } from "../../../web/teach/player/front-drawing";
import { cornersOf } from "../../../web/teach/player/judge";
import { sceneOf } from "../../../web/teach/player/lens-scene";
import { initialPlayerState } from "../../../web/teach/player/player";
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

const alone = { scene: null, recovered: null, fades: true } as const;

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
  expect(drawing.match(/<g /g)?.length).toBe(drawing.match(/<\/g>/g)?.length);
  expect(drawing.trimEnd().endsWith("</svg>")).toBe(true);
});

/** Parts of a drawing that are marked with a name. */
const partsIn = (drawing: string): readonly string[] =>
  [...drawing.matchAll(/data-part="(\w+)"/g)].map(([, name = ""]) => name);

it("keep the outline of the model, the scale of the colours, and the meaning of the marks", () => {
  const plain = frontDrawing(trace, { step: 0, coloring: "size", faces: "all", ...alone }, fromAbove);
  expect(partsIn(plain)).toEqual(["outline", "scale"]);
  // The twelve edges of a box, each divided into three.
  const outline = /<path d="([^"]*)"[^>]*data-part="outline"/.exec(plain)?.[1] ?? "";
  expect(outline.match(/M/g)).toHaveLength(36);
  const step = trace.stepAt(1);
  if (step?.kind !== "advance") throw new Error("step 1 makes no element");
  const scene = sceneOf(trace, { ...initialPlayerState, step: 1, lensStep: 1 });
  const drawing = frontDrawing(trace, { ...alone, step: 1, coloring: "age", faces: "all", scene }, fromAbove);
  expect(partsIn(drawing)).toEqual(["outline", "scale", "legend"]);
  for (const text of ["old", "new", "base face, normal", "why refused"])
    expect(drawing).toContain(`>${text}</text>`);
});

it("fade the front, but keep the light on its faces, their edges and their depth", () => {
  const scene = sceneOf(trace, { ...initialPlayerState, step: 1, lensStep: 1 });
  const faces = frontDrawing(
    trace,
    { ...alone, step: 1, coloring: "age", faces: "all", scene },
    { ...fromAbove, eye: [6, 5, 8] },
  ).matchAll(/<polygon points="[^"]*" fill="(#\w{6})" stroke="(#\w{6})"/g);
  const found = [...faces].map(([, fill = "", stroke = ""]) =>
    [fill, stroke].map((color) => parseInt(color.slice(1, 3), 16)),
  );
  expect(found).toHaveLength(trace.frontAt(1).length);
  // All faces but those of the element have one age: only light and depth tell them apart.
  expect(new Set(found.map(([fill]) => fill)).size).toBeGreaterThan(20);
  for (const [fill = 0, stroke = 0] of found) expect(fill - stroke).toBeGreaterThan(25);
});

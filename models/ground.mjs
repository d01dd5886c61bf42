/** A block of ground: its top is a loft through a grid of heights, the surface whose curvature is continuous. */
import { uniform } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";

/** Heights of a hill with a hollow, a row per y. */
const heights = [
  [0.5, 0.52, 0.56, 0.54, 0.5, 0.46],
  [0.54, 0.66, 0.84, 0.74, 0.52, 0.42],
  [0.56, 0.82, 1.12, 0.9, 0.5, 0.34],
  [0.52, 0.68, 0.86, 0.68, 0.4, 0.28],
  [0.5, 0.54, 0.58, 0.5, 0.4, 0.36],
];
const step = 0.5;

function ground() {
  const builder = new ProjectBuilder();
  const places = heights.map((row, j) => row.map((z, i) => [i * step, j * step, z]));
  const rows = places.map((row, j) => builder.spline(row, `profile ${j + 1}`));
  const left = builder.spline(
    places.map((row) => row[0]),
    "left profile",
  );
  const right = builder.spline(
    places.map((row) => row.at(-1)),
    "right profile",
  );
  const [front, back] = [places[0], places.at(-1)];
  const top = [front[0], front.at(-1), back.at(-1), back[0]];
  const low = top.map(([x, y]) => [x, y, 0]);
  const bottom = builder.polygon(low, "bottom");
  const posts = low.map((at, i) => builder.straight(at, top[i], `corner ${i + 1}`));
  const around = [rows[0], right, -rows.at(-1), -left];
  builder.patch("loft", "ground", around, ...rows.slice(1, -1).map((row) => [row]));
  builder.planar("bottom", turned(bottom));
  ["front", "right", "back", "left"].forEach((name, i) =>
    builder.planar(name, [bottom[i], posts[(i + 1) % 4], -around[i], -posts[i]]),
  );
  uniform(builder, [-0.5, -0.5, -0.5], 12, 0.14);
  return builder;
}

export const models = [
  {
    id: "ground",
    title: "Ground",
    blurb:
      "A block of ground under a loft: splines through a grid of heights, and the surface through all of them, whose curvature is continuous.",
    group: "Curved patches",
    build: ground,
  },
];

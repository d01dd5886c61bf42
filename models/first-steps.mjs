/** The simplest models: planar patches, one bore, one duct. */
import { boxRow, singleTetrahedron } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { arc, box, circle, nextQuarter, quarters, skin, square, xAxis, yAxis } from "./shapes.mjs";

const group = "First steps";

function unitCube() {
  const builder = new ProjectBuilder();
  box(builder, [0, 0, 0], [1, 1, 1]);
  singleTetrahedron(builder, [
    { position: [-0.5, -0.5, -0.5], size: 0.16 },
    { position: [5, -0.5, -0.5], size: 0.16 },
    { position: [-0.5, 5, -0.5], size: 0.16 },
    { position: [-0.5, -0.5, 5], size: 0.16 },
  ]);
  return builder;
}

function squareToCircle() {
  const builder = new ProjectBuilder();
  const height = 2;
  const corners = [[0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0], [-0.5, -0.5, 0]]; // prettier-ignore
  const bottom = square(builder, corners, "square");
  const top = circle(builder, [0, 0, height], 0.5, xAxis, yAxis, "circle");
  const waist = 0.9 * Math.SQRT1_2;
  const edges = corners.map(([x, y], q) => {
    const middle = [x * waist, y * waist, height / 2];
    const end = [x * Math.SQRT1_2, y * Math.SQRT1_2, height];
    return builder.parabola([x, y, 0], middle, end, `edge ${q + 1}`);
  });
  builder.planar("square end", turned(bottom));
  skin(builder, bottom, top, edges, "wall");
  builder.planar("round end", top);
  singleTetrahedron(builder, [
    { position: [0, 0, 12], size: 0.2 },
    { position: [-6, -4, -1], size: 0.11 },
    { position: [6, -4, -1], size: 0.11 },
    { position: [0, 8, -1], size: 0.11 },
  ]);
  return builder;
}

function plateWithHole() {
  const builder = new ProjectBuilder();
  const halfLength = 1;
  const halfWidth = 0.6;
  const thickness = 0.25;
  const radius = 0.3;
  const rectangle = (z) => [[halfLength, -halfWidth, z], [halfLength, halfWidth, z], [-halfLength, halfWidth, z], [-halfLength, -halfWidth, z]]; // prettier-ignore
  const low = rectangle(0);
  const high = rectangle(thickness);
  const bottom = square(builder, low, "bottom");
  const top = square(builder, high, "top");
  const posts = low.map((at, q) => builder.straight(at, high[q], `corner ${q + 1}`));
  const lowRim = circle(builder, [0, 0, 0], radius, xAxis, yAxis, "lower rim");
  const highRim = circle(builder, [0, 0, thickness], radius, xAxis, yAxis, "upper rim");
  const bores = quarters.map((q) => {
    const [at] = arc([0, 0, 0], radius, xAxis, yAxis, 90 * q - 45, 90 * q + 45, 5);
    return builder.straight(at, [at[0], at[1], thickness], `bore ${q + 1}`);
  });
  builder.planar("bottom", turned(bottom), turned(lowRim));
  builder.planar("top", top, highRim);
  const names = ["right", "back", "left", "front"];
  for (const q of quarters) {
    builder.planar(`${names[q]} side`, [bottom[q], posts[nextQuarter(q)], -top[q], -posts[q]]);
  }
  skin(builder, lowRim, highRim, bores, "bore", false);
  const stations = [
    { x: -1.1, size: 0.14 },
    { x: 0, size: 0.07 },
    { x: 1.1, size: 0.14 },
  ];
  boxRow(builder, stations, [-0.7, 0.7], [-0.1, 0.35]);
  return builder;
}

export const models = [
  {
    id: "unit-cube",
    title: "Unit cube",
    blurb: "Six planar patches and a background grid of one tetrahedron. A good model to start with.",
    group,
    build: unitCube,
  },
  {
    id: "square-to-circle",
    title: "Square to circle",
    blurb: "A waisted duct: four Coons patches between a square and a circle.",
    group,
    build: squareToCircle,
  },
  {
    id: "plate-with-hole",
    title: "Plate with a hole",
    blurb: "Planar patches with a round hole, finer around the bore.",
    group,
    build: plateWithHole,
  },
];

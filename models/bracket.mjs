/** An angle bracket with bores; sources make the elements smaller around the bores and in the fillet. */
import { uniform } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { circle, onCircle, quarters, skin, xAxis, yAxis, zAxis } from "./shapes.mjs";

const width = 1.2;
const thickness = 0.22;
const fillet = 0.5; // start of the fillet between the plates, from the outer faces
/** The outline in the plane of x and z, counter-clockwise as seen from the front. */
const outline = [[0, 0], [2, 0], [2, thickness], [fillet, thickness], [thickness, fillet], [thickness, 1.6], [0, 1.6]]; // prettier-ignore
const faces = ["base bottom", "base end", "base top", "fillet", "upright front", "upright end", "upright back"]; // prettier-ignore
const bores = [
  { name: "base bore 1", from: [1.4, 0.32, 0], radius: 0.14, across: xAxis, up: yAxis, along: zAxis },
  { name: "base bore 2", from: [1.4, 0.88, 0], radius: 0.14, across: xAxis, up: yAxis, along: zAxis },
  { name: "upright bore", from: [0, 0.6, 1.08], radius: 0.24, across: yAxis, up: zAxis, along: xAxis },
];

/** The two rims of a bore, which are holes in the plates, and its wall. */
function bore(builder, { name, from, radius, across, up, along }) {
  const to = from.map((c, k) => c + thickness * along[k]);
  const first = circle(builder, from, radius, across, up, `${name} outer rim`);
  const last = circle(builder, to, radius, across, up, `${name} inner rim`);
  const lines = quarters.map((q) => {
    const [start, end] = [from, to].map((centre) => onCircle(centre, radius, across, up, 90 * q - 45));
    return builder.straight(start, end, `${name} line ${q + 1}`);
  });
  skin(builder, first, last, lines, name, false);
  builder.source(`around ${name}`, [from, to], 0.05, { distance: radius + 0.02, growth: 0.25 });
  return { first, last };
}

function bracket() {
  const builder = new ProjectBuilder();
  const profile = (y, label) =>
    outline.map(([x, z], i) => {
      const [nextX, nextZ] = outline[(i + 1) % outline.length];
      const name = `${label} ${faces[i]}`;
      if (faces[i] !== "fillet") return builder.straight([x, y, z], [nextX, y, nextZ], name);
      // The mid-point of a quarter circle between the ends of the plates' inner faces.
      const middle = thickness + (fillet - thickness) * (1 - Math.SQRT1_2);
      return builder.parabola([x, y, z], [middle, y, middle], [nextX, y, nextZ], name);
    });
  const front = profile(0, "front");
  const back = profile(width, "back");
  const across = outline.map(([x, z], i) => builder.straight([x, 0, z], [x, width, z], `edge ${i + 1}`));
  const [one, two, three] = bores.map((each) => bore(builder, each));
  const holes = {
    "base bottom": [one.first, two.first],
    "base top": [one.last, two.last],
    "upright back": [three.first],
    "upright front": [three.last],
  };
  builder.planar("front", front);
  builder.planar("back", turned(back));
  faces.forEach((name, i) => {
    const loop = [across[i], back[i], -across[(i + 1) % across.length], -front[i]];
    builder.patch(name === "fillet" ? "coons" : "planar", name, loop, ...(holes[name] ?? []));
  });
  const [inner, middle] = [fillet - thickness, thickness + 0.08];
  builder.source("along the fillet", [[middle, 0, middle], [middle, width, middle]], 0.07, { distance: inner / 2 }); // prettier-ignore
  builder.source("at the corner", [[2, 0, thickness]], 0.06, { distance: 0.05 });
  const web = [[0, 0.15, 0.75], [0, width - 0.15, 0.75], [0, width / 2, 0.3]]; // prettier-ignore
  builder.source("below the upright bore", web, 0.075, { distance: thickness });
  uniform(builder, [-0.5, -0.5, -0.5], 8, 0.15);
  return builder;
}

export const models = [
  {
    id: "bracket",
    title: "Bracket",
    blurb:
      "Plates with bores and a fillet. Sources make the elements smaller there; elsewhere one size applies.",
    group: "Background grid",
    build: bracket,
  },
];

/** Cavities, regions inside regions, regions side by side. */
import { boxStar, uniform } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { arc, box, circle, onCircle, quarters, scaledTo, skin, unitMiddle, xAxis, yAxis, zAxis } from "./shapes.mjs"; // prettier-ignore

const negative = (axis) => axis.map((c) => -c);

/** Eight octants. The quarter of the equator is the second line of each, F2 in equation (14). */
function octants(builder, radius) {
  const quarter = (from, to, name) => builder.spline(arc([0, 0, 0], radius, from, to, 0, 90, 7), name);
  for (const [pole, label] of [
    [zAxis, "upper"],
    [negative(zAxis), "lower"],
  ]) {
    // prettier-ignore
    const around = [xAxis, yAxis, negative(xAxis), negative(yAxis)];
    quarters.forEach((q) => {
      const [from, to] = [around[q], around[(q + 1) % 4]];
      const loop = [
        quarter(pole, from, `${label} meridian ${q + 1}`),
        quarter(from, to, `equator ${q + 1}`),
        quarter(to, pole, `${label} meridian ${((q + 1) % 4) + 1}`),
      ];
      // Ordered as seen from inside the ball: the material is outside it.
      const name = `ball ${label} ${q + 1}`;
      builder.patch("barnhill-gregory-nielson", name, label === "upper" ? turned(loop) : loop);
    });
  }
}

function sphereInBox() {
  const builder = new ProjectBuilder();
  octants(builder, 0.5);
  box(builder, [-1, -1, -1], [1, 1, 1], "box");
  boxStar(builder, [-1.1, -1.1, -1.1], [1.1, 1.1, 1.1], { position: [0, 0, 0], size: 0.07 }, 0.28);
  return builder;
}

const golden = (1 + Math.sqrt(5)) / 2;
/** The corners of an icosahedron, in cyclic permutations. */
const icosahedron = [-1, 1].flatMap(
  (a) =>
  [-golden, golden].flatMap((b) => [[0, a, b], [a, b, 0], [b, 0, a]].map((at) => scaledTo(at, 1))), // prettier-ignore
);

/** Its faces, counter-clockwise as seen from outside: triples of neighbouring corners. */
function icosahedronFaces() {
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; // prettier-ignore
  const near = (a, b) => dot(icosahedron[a], icosahedron[b]) > 0.4; // cosine of the edge's angle: 0.447
  const faces = [];
  for (let a = 0; a < 12; ++a) {
    for (let b = a + 1; b < 12; ++b) {
      for (let c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const volume = dot(icosahedron[a], cross(icosahedron[b], icosahedron[c]));
        faces.push(volume > 0 ? [a, b, c] : [a, c, b]);
      }
    }
  }
  return faces;
}

/** A ball of twenty isoparametric triangles with the mid-points of their edges on the sphere. */
function ball(builder, radius, label, materialInside) {
  icosahedronFaces().forEach((corners, f) => {
    const loop = corners.map((from, i) => {
      const [start, end] = [from, corners[(i + 1) % 3]].map((corner) => icosahedron[corner]);
      const places = [start, unitMiddle(start, end), end].map((at) => scaledTo(at, radius));
      return builder.parabola(...places);
    });
    const seen = materialInside ? loop : turned(loop);
    builder.patch("isoparametric-triangle", `${label} ${f + 1}`, seen);
  });
}

function coreInShell() {
  const builder = new ProjectBuilder();
  ball(builder, 1, "shell outside", true);
  ball(builder, 0.74, "shell inside", false);
  ball(builder, 0.52, "core", true);
  uniform(builder, [-1.5, -1.5, -1.5], 9, 0.123);
  return builder;
}

const wire = 0.16;
const bend = 0.46; // radius of the wire's axis at a link's ends
const halfStraight = 0.5;

/** A link of a chain: straight along x between two half turns, in the plane of x and `aside`. */
function link(builder, offset, aside, above, label) {
  const place = ([x, y]) => [offset, 0, 0].map((c, k) => c + x * xAxis[k] + y * aside[k]);
  // The ends of the wire's straight and bent pieces, and at the tops of the bends.
  const pieces = [
    { centre: [halfStraight, 0], from: -90, to: 0 },
    { centre: [halfStraight, 0], from: 0, to: 90 },
    { centre: [-halfStraight, 0], from: 90, to: 180 },
    { centre: [-halfStraight, 0], from: 180, to: 270 },
  ];
  const outward = (degrees) => onCircle([0, 0, 0], 1, xAxis, aside, degrees);
  const section = ({ centre }, degrees) => {
    const axis = place(centre).map((c, k) => c + bend * outward(degrees)[k]);
    return circle(builder, axis, wire, outward(degrees), above, `${label} section`);
  };
  const corner = (q) => onCircle([0, 0], wire, [1, 0], [0, 1], 90 * q - 45);
  const lengthwise = ({ centre, from, to }) =>
    quarters.map((q) => {
      const [out, up] = corner(q);
      const middle = place(centre).map((c, k) => c + up * above[k]);
      return builder.spline(arc(middle, bend + out, xAxis, aside, from, to, 7), `${label} bend`);
    });
  const straight = (first, last, degrees) =>
    quarters.map((q) => {
      const [out, up] = corner(q);
      const ends = [first, last].map(({ centre }) =>
        place(centre).map((c, k) => c + (bend + out) * outward(degrees)[k] + up * above[k]),
      );
      return builder.straight(...ends, `${label} straight`);
    });
  pieces.forEach((piece, i) => {
    const start = section(piece, piece.from);
    const end = section(piece, piece.to);
    skin(builder, start, end, lengthwise(piece), `${label} bend ${i + 1}`, false);
    const after = pieces[(i + 1) % pieces.length];
    if (after.centre === piece.centre || after.centre[0] === piece.centre[0]) return;
    const across = straight(piece, after, piece.to);
    const far = section(after, after.from);
    skin(builder, end, far, across, `${label} straight ${i === 1 ? 1 : 2}`, false);
  });
}

function chain() {
  const builder = new ProjectBuilder();
  const gap = 0.08;
  const pitch = 2 * (halfStraight + bend) - 2 * wire - gap;
  link(builder, 0, zAxis, negative(yAxis), "first link");
  link(builder, pitch, yAxis, zAxis, "second link");
  uniform(builder, [-1.5, -1, -1], 12, 0.085);
  return builder;
}

export const models = [
  {
    id: "sphere-in-a-box",
    title: "Sphere in a box",
    blurb: "A cavity of eight Barnhill–Gregory–Nielson octants; the sizes grow from it to the walls.",
    group: "Regions and cavities",
    build: sphereInBox,
  },
  {
    id: "core-in-a-shell",
    title: "Core in a shell",
    blurb: "Two regions, one in the cavity of the other, of sixty isoparametric triangles. Cut it open.",
    group: "Regions and cavities",
    build: coreInShell,
  },
  {
    id: "chain",
    title: "Chain",
    blurb: "Two rings of Coons patches that pass through each other without touching.",
    group: "Regions and cavities",
    build: chain,
  },
];

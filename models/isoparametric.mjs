/** The paper's isoparametric patches, all of parabolic lines: equations 11 to 13. */
import { singleTetrahedron, uniform } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { onCircle, ruledRow, scaledTo, unitMiddle, xAxis, yAxis } from "./shapes.mjs";

/** A straight edge of an isoparametric patch is a parabola through its midpoint. */
const straightParabola = (builder, from, to, name) =>
  builder.parabola(from, from.map((c, k) => (c + to[k]) / 2), to, name); // prettier-ignore

function barrel() {
  const builder = new ProjectBuilder();
  const staves = 6;
  const halfHeight = 0.9;
  const endRadius = 0.62;
  const bellyRadius = 0.85;
  const step = 360 / staves;
  const each = Array.from({ length: staves }, (_, i) => i);
  const at = (z, radius, degrees) => onCircle([0, 0, z], radius, xAxis, yAxis, degrees);
  const ring = (z, label) =>
    each.map((i) => {
      const [from, middle, to] = [i, i + 0.5, i + 1].map((turn) => at(z, endRadius, step * turn));
      return builder.parabola(from, middle, to, `${label} ${i + 1}`);
    });
  const bottom = ring(-halfHeight, "lower rim");
  const top = ring(halfHeight, "upper rim");
  const seams = each.map((i) => {
    const [from, to] = [-halfHeight, halfHeight].map((z) => at(z, endRadius, step * i));
    return builder.parabola(from, at(0, bellyRadius, step * i), to, `seam ${i + 1}`);
  });
  const names = each.map((i) => `stave ${i + 1}`);
  ruledRow(builder, bottom, top, seams, names, { type: "serendipity" });
  builder.planar("floor", turned(bottom));
  builder.planar("lid", top);
  singleTetrahedron(builder, [
    { position: [0, 0, 6], size: 0.2 },
    { position: [-6, -4, -1.5], size: 0.12 },
    { position: [6, -4, -1.5], size: 0.12 },
    { position: [0, 8, -1.5], size: 0.12 },
  ]);
  return builder;
}

/** Rotated to stand on its three feet: the diagonal of the first octant becomes z. */
const upright = ([x, y, z]) => [
  (x - y) / Math.sqrt(2),
  (x + y - 2 * z) / Math.sqrt(6),
  (x + y + z) / Math.sqrt(3),
];

const octant = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]; // prettier-ignore

/** One octant of a spherical shell, each face of four triangles. */
function vault() {
  const builder = new ProjectBuilder();
  const radii = { outer: 1, inner: 0.82 };
  const middles = octant.map((from, i) => unitMiddle(from, octant[(i + 1) % 3]));
  const curve = (radius, from, to) => {
    const places = [from, unitMiddle(from, to), to];
    return builder.parabola(...places.map((at) => upright(scaledTo(at, radius))));
  };
  for (const [label, radius] of Object.entries(radii)) {
    const triangle = (name, corners) => {
      const loop = corners.map((at, i) => curve(radius, at, corners[(i + 1) % 3]));
      const seen = label === "outer" ? loop : turned(loop);
      builder.patch("isoparametric-triangle", `${label} ${name}`, seen);
    };
    octant.forEach((foot, i) => triangle(`foot ${i + 1}`, [foot, middles[i], middles[(i + 2) % 3]]));
    triangle("crown", middles);
  }
  const radial = (at) =>
    straightParabola(builder, ...[radii.outer, radii.inner].map((r) => upright(scaledTo(at, r))));
  octant.forEach((foot, i) => {
    const stations = [foot, middles[i], octant[(i + 1) % 3]];
    for (const half of [0, 1]) {
      const [from, to] = [stations[half], stations[half + 1]];
      const loop = [curve(radii.inner, from, to), -radial(to), -curve(radii.outer, from, to), radial(from)]; // prettier-ignore
      builder.patch("serendipity", `arch ${i + 1} ${half === 0 ? "rising" : "falling"}`, loop);
    }
  });
  uniform(builder, [-1.5, -1.5, -0.5], 8, 0.08);
  return builder;
}

export const models = [
  {
    id: "barrel",
    title: "Barrel",
    blurb: "Six staves, each one serendipity patch of four parabolic lines.",
    group: "Curved patches",
    build: barrel,
  },
  {
    id: "vault",
    title: "Vault on three feet",
    blurb:
      "An octant of a spherical shell: isoparametric triangles of parabolic lines, and serendipity arches.",
    group: "Curved patches",
    build: vault,
  },
];

/** Positions and lines that several models use. */
import { turned } from "./project-builder.mjs";

export const xAxis = [1, 0, 0];
export const yAxis = [0, 1, 0];
export const zAxis = [0, 0, 1];
export const quarters = [0, 1, 2, 3];
export const nextQuarter = (quarter) => (quarter + 1) % 4;

const radians = (degrees) => (degrees * Math.PI) / 180;

/** Rises from 0 to 1 with zero slope at both ends. */
export const smoothStep = (t) => t * t * (3 - 2 * t);

/** Evenly spaced numbers, both ends included. */
export const spread = (from, to, count) =>
  Array.from({ length: count }, (_, i) => from + ((to - from) * i) / (count - 1));

/** The position at an angle on a circle around a centre, in the plane of two unit axes. */
export const onCircle = (centre, radius, across, up, degrees) => {
  const cosine = Math.cos(radians(degrees));
  const sine = Math.sin(radians(degrees));
  return centre.map((c, k) => c + radius * (cosine * across[k] + sine * up[k]));
};

/** Positions on a circle, from one angle to another. */
export const arc = (centre, radius, across, up, fromDegrees, toDegrees, count) =>
  spread(fromDegrees, toDegrees, count).map((degrees) => onCircle(centre, radius, across, up, degrees));

/** Four lines of a closed section, one per quarter, starting on the diagonal below right. */
export const circle = (builder, centre, radius, across, up, label) =>
  quarters.map((q) =>
    builder.spline(arc(centre, radius, across, up, 90 * q - 45, 90 * q + 45, 5), `${label} arc ${q + 1}`),
  );

export const square = (builder, corners, label) => builder.polygon(corners, `${label} edge`);

/** The position in the same direction from the origin, at this distance. */
export const scaledTo = (at, radius) => {
  const length = Math.hypot(...at);
  return at.map((c) => (c * radius) / length);
};

/** The position on the unit sphere half-way between two others. */
export const unitMiddle = (a, b) =>
  scaledTo(
    a.map((c, k) => c + b[k]),
    1,
  );

/** For a row of patches with the material outside it. */
export const materialAround = { materialInside: false };

/**
 * Four-sided patches between two sections with the same number of lines, connected by lengthwise lines. The row is
 * closed if it has as many of these as a section has lines, and open with one more. `names` has one name per
 * patch.
 */
export const ruledRow = (
  builder,
  first,
  last,
  lengthwise,
  names,
  { materialInside = true, type = "coons" } = {},
) => {
  names.forEach((name, i) => {
    const loop = [first[i], lengthwise[(i + 1) % lengthwise.length], -last[i], -lengthwise[i]];
    builder.patch(type, name, materialInside ? loop : turned(loop));
  });
};

/** Four Coons patches between two closed sections; the material lies inside them, or around them. */
export const skin = (builder, first, last, lengthwise, label, materialInside = true) => {
  const names = ["right", "top", "left", "bottom"].map((side) => `${label} ${side}`);
  ruledRow(builder, first, last, lengthwise, names, { materialInside });
};

const boxFaces = {
  left: [0, 4, 6, 2],
  right: [1, 3, 7, 5],
  front: [0, 1, 5, 4],
  back: [2, 6, 7, 3],
  bottom: [0, 2, 3, 1],
  top: [4, 5, 7, 6],
};

/** Six planar patches around the box between two corners. `holes` gives further loops by the name of a face. */
export const box = (builder, low, high, label, { holes = {}, materialInside = true } = {}) => {
  const corner = (code) => [0, 1, 2].map((k) => ((code >> k) & 1 ? high[k] : low[k]));
  for (const [face, codes] of Object.entries(boxFaces)) {
    const loop = builder.polygon(codes.map(corner));
    const outer = materialInside ? loop : turned(loop);
    builder.planar(label ? `${label} ${face}` : face, outer, ...(holes[face] ?? []));
  }
};

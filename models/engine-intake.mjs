/**
 * Löhner & Parikh 1988, section 7.1: half an engine intake, from a square at the inlet to a circle at
 * the outlet, with a centrebody that begins inside. The symmetry plane y = 0 closes it.
 */
import { halfPrismsAlongAxis } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { arc, materialAround, onCircle, ruledRow, smoothStep, spread, yAxis, zAxis } from "./shapes.mjs";

const inletHalf = 1;
const roundFrom = 3.2; // the section is a circle from here on
const length = 5;
const outletRadius = 0.95;
const noseAt = 2.3;
const shoulderAt = 3.1; // end of the elliptic nose
const shoulderRadius = 0.36;
const hubRadius = 0.46;

/** The lines along the intake: those of 1988, or Hermite lines, which continue each other. */
const lengthwise = (kind) => (kind === "smooth" ? "hermite" : "spline");
const fourLines = (kind) => (kind === "smooth" ? "gregory" : "coons");

/** A part of a circle: the spline of 1988 through some places, or the exact arc. */
const ringPart = (builder, kind, places, name) =>
  kind === "smooth"
    ? builder.line("arc", [places[0], places[(places.length - 1) / 2], places.at(-1)], name)
    : builder.spline(places, name);

/** Positions along a quarter of an ellipse in the plane of the axis and `across`, from tip to shoulder. */
const noseProfile = (across) =>
  spread(0, 90, 7).map((degrees) => {
    const angle = (degrees * Math.PI) / 180;
    const x = shoulderAt - (shoulderAt - noseAt) * Math.cos(angle);
    return across.map((c, k) => c * shoulderRadius * Math.sin(angle) + (k === 0 ? x : 0));
  });

const bodyProfile = (across) =>
  spread(0, 1, 6).map((t) => {
    const radius = shoulderRadius + (hubRadius - shoulderRadius) * smoothStep(t);
    return across.map((c, k) => c * radius + (k === 0 ? shoulderAt + (length - shoulderAt) * t : 0));
  });

/** From the corners of the inlet to the corresponding positions on the circle. */
function ductEdges(builder, kind) {
  const corners = [[0, -1], [1, -1], [1, 1], [0, 1]]; // prettier-ignore
  const names = ["keel", "lower edge", "upper edge", "crown"];
  return corners.map(([y, z], i) => {
    const [, yEnd, zEnd] = onCircle([0, 0, 0], outletRadius, yAxis, zAxis, [-90, -45, 45, 90][i]);
    const places = spread(0, 1, 9).map((t) => {
      const s = smoothStep(t);
      const between = (from, to) => from * inletHalf + (to - from * inletHalf) * s;
      return [roundFrom * t, between(y, yEnd), between(z, zEnd)];
    });
    return builder.line(lengthwise(kind), places, names[i]);
  });
}

function duct(builder, kind) {
  const sides = ["bottom", "side", "top"];
  const inlet = [[0, 0, -1], [0, 1, -1], [0, 1, 1], [0, 0, 1]] // prettier-ignore
    .map((at) => at.map((c) => c * inletHalf));
  const inletLines = sides.map((side, i) => builder.straight(inlet[i], inlet[i + 1], `inlet ${side}`));
  const angles = [[-90, -45], [-45, 45], [45, 90]]; // prettier-ignore
  const section = (x, label) =>
    angles.map(([from, to], i) =>
      ringPart(
        builder,
        kind,
        arc([x, 0, 0], outletRadius, yAxis, zAxis, from, to, to - from > 45 ? 7 : 5),
        `${label} ${sides[i]}`,
      ),
    );
  const throat = section(roundFrom, "throat");
  const outlet = section(length, "outlet");
  const edges = ductEdges(builder, kind);
  const barrel = [-90, -45, 45, 90].map((degrees, i) =>
    builder.line(
      kind === "smooth" ? "hermite" : "straight",
      [roundFrom, length].map((x) => onCircle([x, 0, 0], outletRadius, yAxis, zAxis, degrees)),
      `barrel line ${i + 1}`,
    ),
  );
  const inletMid = builder.straight(inlet[3], inlet[0], "inlet midline");
  builder.planar("inlet", turned([...inletLines, inletMid]));
  const type = fourLines(kind);
  ruledRow(builder, inletLines, throat, edges, sides.map((side) => `duct ${side}`), { type }); // prettier-ignore
  ruledRow(builder, throat, outlet, barrel, sides.map((side) => `barrel ${side}`), { type }); // prettier-ignore
  return { outlet, inletMid, crown: [edges[3], barrel[3]], keel: [edges[0], barrel[0]] };
}

function centrebody(builder, kind) {
  const down = zAxis.map((c) => -c);
  const ring = (x, radius, label) => [
    ringPart(builder, kind, arc([x, 0, 0], radius, yAxis, zAxis, -90, 0, 7), `${label} below`),
    ringPart(builder, kind, arc([x, 0, 0], radius, yAxis, zAxis, 0, 90, 7), `${label} above`),
  ];
  const shoulder = ring(shoulderAt, shoulderRadius, "shoulder");
  const hub = ring(length, hubRadius, "hub");
  const [noseDown, noseSide, noseUp] = [down, yAxis, zAxis].map((across, i) =>
    builder.line(lengthwise(kind), noseProfile(across), `nose ${["below", "beside", "above"][i]}`),
  );
  const ribs = [down, yAxis, zAxis].map((across, i) =>
    builder.line(lengthwise(kind), bodyProfile(across), `centrebody ${["below", "beside", "above"][i]}`),
  );
  // The quarter of the shoulder opposite the tip is the second line, which eq. (14) treats differently from the
  // other two.
  const threeLines = kind === "smooth" ? "nielson" : "barnhill-gregory-nielson";
  builder.patch(threeLines, "nose below", [noseDown, shoulder[0], -noseSide]);
  builder.patch(threeLines, "nose above", [noseSide, shoulder[1], -noseUp]);
  const around = { ...materialAround, type: fourLines(kind) };
  ruledRow(builder, shoulder, hub, ribs, ["centrebody below", "centrebody above"], around);
  return { hub, above: [noseUp, ribs[2]], below: [noseDown, ribs[0]] };
}

function engineIntake(kind) {
  const builder = new ProjectBuilder();
  builder.point([noseAt, 0, 0], "nose of the centrebody");
  const { outlet, inletMid, crown, keel } = duct(builder, kind);
  const { hub, above, below } = centrebody(builder, kind);
  const gap = (sign, name) =>
    builder.straight([length, 0, sign * outletRadius], [length, 0, sign * hubRadius], name);
  const upper = gap(1, "outlet midline above");
  const lower = gap(-1, "outlet midline below");
  builder.planar("outlet", [...outlet, upper, ...turned(hub), -lower]);
  const loop = [...keel, lower, ...turned(below), ...above, -upper, ...turned(crown), inletMid];
  builder.planar("symmetry plane", loop);
  halfPrismsAlongAxis(builder, [
    { x: -0.2, inner: 0.35, outer: 0.35, reach: 2.4 },
    { x: noseAt, inner: 0.013, outer: 0.34, reach: 2.4 },
    { x: length + 0.2, inner: 0.135, outer: 0.28, reach: 2.4 },
  ]);
  builder.meshing = { interior: "front" }; // as in 1988
  return builder;
}

export const models = [
  {
    id: "engine-intake",
    title: "Engine intake",
    blurb:
      "Half an intake with a centrebody that begins inside, from a square inlet to a round outlet. The first example of Löhner and Parikh, finest at the nose.",
    group: "The paper's examples",
    build: () => engineIntake("paper"),
  },
  {
    id: "smooth-intake",
    title: "Engine intake, smooth",
    blurb:
      "The same intake without kinks: Hermite lines continue each other, circles are exact, and neighbouring patches have one normal along their common lines. Turn on the zebra stripes to compare it with the one of 1988.",
    group: "The paper's examples",
    build: () => engineIntake("smooth"),
  },
];

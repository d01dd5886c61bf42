/**
 * Löhner & Parikh 1988, section 7.2: a generic missile launcher. Half of the air around a missile that hangs on a
 * rail under a pylon; the symmetry plane y = 0 closes it. The nose points against the flow, to -x, and the ceiling
 * is the lower side of a wing.
 */
import { halfPrismsAlongAxis } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { arc, materialAround, onCircle, ruledRow, spread, yAxis, zAxis } from "./shapes.mjs";

const radius = 0.25;
const noseLength = 0.65;
const railFrom = 1.3;
const railTo = 2.7;
const finFrom = 3.0;
const finTo = 3.7;
const tail = 3.9;
// The rail's side meets the missile in a straight line; a 3-4-5 triangle makes its height exact.
const railHalf = 0.15;
const railAngle = (Math.acos(railHalf / radius) * 180) / Math.PI;
const railTop = 0.42;
const railSlant = 0.2;
const ceiling = 1.3;
const outside = { fromX: -1.6, toX: 6, side: 2.2, floor: -1.7 };
const finSpan = 0.42;
const finHalfThickness = 0.03;

/** Angles of the seams along the missile: below, beside, at the rail's side, above. */
const seams = [-90, 0, railAngle, 90];
const strips = ["below", "beside", "above"];
const at = (x, degrees, r = radius) => onCircle([x, 0, 0], r, yAxis, zAxis, degrees);

const ring = (builder, x, label) =>
  strips.map((strip, i) =>
    builder.spline(arc([x, 0, 0], radius, yAxis, zAxis, seams[i], seams[i + 1], 5), `${label} ${strip}`),
  );

const along = (builder, fromX, toX, label) =>
  seams.map((degrees, i) => builder.straight(at(fromX, degrees), at(toX, degrees), `${label} seam ${i + 1}`));

/** An elliptic nose of three patches that meet at the tip. */
function nose(builder, shoulder) {
  builder.point([0, 0, 0], "nose of the missile");
  const profiles = seams.map((degrees, i) => {
    const places = spread(0, 90, 7).map((turn) => {
      const angle = (turn * Math.PI) / 180;
      return at(noseLength * (1 - Math.cos(angle)), degrees, radius * Math.sin(angle));
    });
    return builder.spline(places, `nose seam ${i + 1}`);
  });
  strips.forEach((strip, i) => {
    const loop = [profiles[i], shoulder[i], -profiles[i + 1]];
    builder.patch("barnhill-gregory-nielson", `nose ${strip}`, loop);
  });
  return profiles;
}

/**
 * A fin on the seam at an angle. Its root opens from the seam on the given sides (-1, 1) and closes again; its
 * other edges are sharp. Returns the outline in the seam's plane and the roots by side.
 */
function fin(builder, degrees, sides, label) {
  const outer = radius + finSpan;
  const tipFrom = finFrom + 0.36;
  const [front, back] = [at(finFrom, degrees), at(finTo, degrees)];
  // Both tip corners are blunt: in a sharp corner, both sides of the fin would have the same triangle of edge
  // nodes.
  const tipTo = finTo - 0.14;
  const [tipFront, tipBack] = [at(tipFrom, degrees, outer), at(tipTo, degrees, outer)];
  const outline = [
    builder.straight(front, tipFront, `${label} leading edge`),
    builder.straight(tipFront, tipBack, `${label} tip`),
    builder.straight(tipBack, back, `${label} trailing edge`),
  ];
  const widest = ((finHalfThickness / radius) * 180) / Math.PI;
  const roots = Object.fromEntries(
    sides.map((side) => {
      const places = spread(0, 1, 7).map((t) =>
        at(finFrom + (finTo - finFrom) * t, degrees + side * 4 * t * (1 - t) * widest),
      );
      const root = builder.spline(places, `${label} root ${side < 0 ? "below" : "above"}`);
      const loop = [...outline, -root];
      builder.coons(`${label} ${side < 0 ? "below" : "above"}`, side < 0 ? turned(loop) : loop);
      return [side, root];
    }),
  );
  return { outline, roots };
}

function missile(builder) {
  const rings = [
    ring(builder, noseLength, "shoulder"),
    ring(builder, railFrom, "rail front"),
    ring(builder, railTo, "rail back"),
    ring(builder, finFrom, "fin front"),
    ring(builder, finTo, "fin back"),
    ring(builder, tail, "tail"),
  ];
  const profiles = nose(builder, rings[0]);
  const front = along(builder, noseLength, railFrom, "front body");
  const middle = along(builder, railFrom, railTo, "rail");
  const rear = along(builder, railTo, finFrom, "rear body");
  const end = along(builder, finTo, tail, "tail");
  const belowFin = fin(builder, -90, [1], "lower fin");
  const sideFin = fin(builder, 0, [-1, 1], "side fin");
  const aboveFin = fin(builder, 90, [-1], "upper fin");
  const finSeam = builder.straight(at(finFrom, railAngle), at(finTo, railAngle), "fin seam");
  const names = (label) => strips.map((strip) => `${label} ${strip}`);
  ruledRow(builder, rings[0], rings[1], front, names("front body"), materialAround);
  ruledRow(builder, rings[1], rings[2], middle, names("rail body").slice(0, 2), materialAround);
  ruledRow(builder, rings[2], rings[3], rear, names("rear body"), materialAround);
  // Between the fins, their roots bound a strip.
  const rows = [
    [belowFin.roots[1], sideFin.roots[-1]],
    [sideFin.roots[1], finSeam],
    [finSeam, aboveFin.roots[-1]],
  ];
  rows.forEach((row, i) =>
    ruledRow(builder, [rings[3][i]], [rings[4][i]], row, [`fin body ${strips[i]}`], materialAround),
  );
  ruledRow(builder, rings[4], rings[5], end, names("tail"), materialAround);
  const base = builder.straight(at(tail, 90), at(tail, -90), "base midline");
  builder.planar("base", turned([...rings[5], base]));
  return {
    railEnds: [rings[1][2], rings[2][2]],
    railSeam: middle[2],
    railTopSeam: middle[3],
    below: [profiles[0], front[0], middle[0], rear[0], ...belowFin.outline, end[0]],
    aboveBeforeRail: [profiles[3], front[3]],
    aboveAfterRail: [rear[3], ...aboveFin.outline, end[3]],
    base,
  };
}

/** Half a lens from a leading to a trailing edge, as a spline. */
const lens = (builder, fromX, toX, half, z, label) =>
  builder.spline(
    spread(0, 1, 7).map((t) => [fromX + (toX - fromX) * t, half * 4 * t * (1 - t), z]),
    label,
  );

function rail(builder, { railEnds, railSeam }) {
  const frontX = railFrom + railSlant;
  const backX = railTo - railSlant;
  const seamEnd = (x) => at(x, railAngle);
  const crest = (x) => at(x, 90);
  const pylonFoot = { from: frontX + 0.15, to: backX - 0.15 };
  const frontLine = builder.straight(crest(railFrom), [frontX, 0, railTop], "rail front midline");
  const backLine = builder.straight(crest(railTo), [backX, 0, railTop], "rail back midline");
  const frontEdge = builder.straight(seamEnd(railFrom), [frontX, railHalf, railTop], "rail front edge");
  const backEdge = builder.straight(seamEnd(railTo), [backX, railHalf, railTop], "rail back edge");
  const frontTop = builder.straight([frontX, railHalf, railTop], [frontX, 0, railTop], "rail front top");
  const backTop = builder.straight([backX, railHalf, railTop], [backX, 0, railTop], "rail back top");
  const topEdge = builder.straight([frontX, railHalf, railTop], [backX, railHalf, railTop], "rail top edge");
  const topFront = builder.straight(
    [frontX, 0, railTop],
    [pylonFoot.from, 0, railTop],
    "rail top before the pylon",
  );
  const topBack = builder.straight(
    [pylonFoot.to, 0, railTop],
    [backX, 0, railTop],
    "rail top after the pylon",
  );
  const foot = lens(builder, pylonFoot.from, pylonFoot.to, 0.07, railTop, "pylon foot");
  builder.planar("rail side", [railSeam, backEdge, -topEdge, -frontEdge]);
  builder.coons("rail front", turned([railEnds[0], frontLine, -frontTop, -frontEdge]));
  builder.coons("rail back", turned([backEdge, backTop, -backLine, -railEnds[1]]));
  builder.planar("rail top", [topEdge, backTop, -topBack, -foot, -topFront, -frontTop]);
  return { pylonFoot, foot, before: [frontLine, topFront], after: [topBack, -backLine] };
}

function pylon(builder, { pylonFoot, foot }) {
  const [fromX, toX] = [pylonFoot.from - 0.35, pylonFoot.to + 0.05];
  const root = lens(builder, fromX, toX, 0.09, ceiling, "pylon root");
  const leading = builder.straight([pylonFoot.from, 0, railTop], [fromX, 0, ceiling], "pylon leading edge");
  const trailing = builder.straight([pylonFoot.to, 0, railTop], [toX, 0, ceiling], "pylon trailing edge");
  builder.coons("pylon", [foot, trailing, -root, -leading]);
  return { root, leading, trailing, fromX, toX };
}

/** The walls of the flow domain, the ceiling around the pylon and the symmetry plane around all. */
function surroundings(builder, missileLines, railLines, pylonLines) {
  const { fromX, toX, side, floor } = outside;
  const { below, aboveBeforeRail, aboveAfterRail, base } = missileLines;
  const corner = (x, y, z) => [x ? toX : fromX, y ? side : 0, z ? ceiling : floor];
  const edge = (a, b) => builder.straight(corner(...a), corner(...b));
  const face = (name, ...corners) =>
    builder.planar(name, corners.map((c, i) => edge(c, corners[(i + 1) % 4]))); // prettier-ignore
  face("inflow", [0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]);
  face("outflow", [1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]);
  face("far side", [0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]);
  face("floor", [0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]);
  const ceilingFront = builder.straight(
    corner(0, 0, 1),
    [pylonLines.fromX, 0, ceiling],
    "wing before the pylon",
  );
  const ceilingBack = builder.straight([pylonLines.toX, 0, ceiling], corner(1, 0, 1), "wing after the pylon");
  const rim = [edge([1, 0, 1], [1, 1, 1]), edge([1, 1, 1], [0, 1, 1]), edge([0, 1, 1], [0, 0, 1])];
  builder.planar("wing", [ceilingFront, pylonLines.root, ceilingBack, ...rim]);
  builder.planar("symmetry plane", [
    edge([0, 0, 0], [1, 0, 0]),
    edge([1, 0, 0], [1, 0, 1]),
    -ceilingBack,
    -pylonLines.trailing,
    ...railLines.after,
    ...aboveAfterRail,
    base,
    ...turned(below),
    ...aboveBeforeRail,
    ...railLines.before,
    pylonLines.leading,
    -ceilingFront,
    edge([0, 0, 1], [0, 0, 0]),
  ]);
}

function missileLauncher() {
  const builder = new ProjectBuilder();
  const missileLines = missile(builder);
  const railLines = rail(builder, missileLines);
  const pylonLines = pylon(builder, railLines);
  surroundings(builder, missileLines, railLines, pylonLines);
  const reach = 4.5;
  halfPrismsAlongAxis(builder, [
    { x: -1.8, inner: 0.4, outer: 0.57, reach },
    { x: 0, inner: 0.046, outer: 0.76, reach },
    { x: tail, inner: 0.079, outer: 0.76, reach },
    { x: 6.2, inner: 0.46, outer: 0.57, reach },
  ]);
  builder.meshing = { interior: "front" }; // as in 1988
  return builder;
}

export const models = [
  {
    id: "missile-launcher",
    title: "Missile launcher",
    blurb:
      "Half the air around a missile on its rail, under a pylon. The second example of Löhner and Parikh.",
    group: "The paper's examples",
    build: missileLauncher,
  },
];

/** Three equal tubes that meet at 120 degrees. */
import { singleTetrahedron } from "./background.mjs";
import { ProjectBuilder } from "./project-builder.mjs";
import { arc, quarters, ruledRow, spread, yAxis } from "./shapes.mjs";

const radius = 0.45;
const stemLength = 2;
const branchLength = 1.7;

/** A position in the plane y = 0, by its angle to x. */
const direction = (degrees) => {
  const angle = (degrees * Math.PI) / 180;
  return [Math.cos(angle), 0, Math.sin(angle)];
};

/** The quarter of an ellipse where two tubes meet, from y = side * radius to the bisector. */
const mitre = (builder, bisector, side, label) => {
  const reach = radius / Math.sin(Math.PI / 3);
  const places = spread(0, 90, 6).map((degrees) => {
    const angle = (degrees * Math.PI) / 180;
    const along = reach * Math.sin(angle);
    return [bisector[0] * along, side * radius * Math.cos(angle), bisector[2] * along];
  });
  return builder.spline(places, label);
};

/**
 * A tube at an angle: its ring and its junction have four quarters each, starting at the front and continuing to
 * the side that is 90 degrees behind.
 */
function tube(builder, { name, degrees, length }) {
  const along = direction(degrees);
  const aside = direction(degrees - 90);
  const front = yAxis.map((c) => -c);
  const centre = along.map((c) => c * length);
  const ring = quarters.map((q) =>
    builder.spline(arc(centre, radius, front, aside, 90 * q, 90 * q + 90, 5), `${name} ring ${q + 1}`),
  );
  const meet = (offset, side) => {
    const between = Math.round(degrees + offset + 360) % 360;
    const label = `mitre at ${between}° ${side < 0 ? "front" : "back"}`;
    return mitre(builder, direction(between), side, label);
  };
  const junction = [meet(-60, -1), -meet(-60, 1), meet(60, 1), -meet(60, -1)];
  const starts = (line) => {
    const { points } = builder.lines[Math.abs(line) - 1];
    return builder.points[(line > 0 ? points[0] : points.at(-1)) - 1].position;
  };
  const seams = quarters.map((q) =>
    builder.straight(starts(junction[q]), starts(ring[q]), `${name} seam ${q + 1}`),
  );
  const names = quarters.map((q) => `${name} ${q + 1}`);
  ruledRow(builder, junction, ring, seams, names);
  builder.planar(`${name} end`, ring);
}

function yPipe() {
  const builder = new ProjectBuilder();
  tube(builder, { name: "stem", degrees: 270, length: stemLength });
  tube(builder, { name: "right branch", degrees: 30, length: branchLength });
  tube(builder, { name: "left branch", degrees: 150, length: branchLength });
  singleTetrahedron(builder, [
    { position: [0, 0, 7], size: 0.17 },
    { position: [-8, -5, -3], size: 0.14 },
    { position: [8, -5, -3], size: 0.14 },
    { position: [0, 9, -3], size: 0.14 },
  ]);
  return builder;
}

export const models = [
  {
    id: "y-pipe",
    title: "Y-pipe",
    blurb: "Three tubes that meet at 120°, in quarters: twelve Coons patches and three planar ends.",
    group: "Curved patches",
    build: yPipe,
  },
];

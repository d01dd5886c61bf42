/** An S-shaped intake with a blunt centrebody, whole. */
import { boxRow } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { circle, skin, smoothStep, square, yAxis, zAxis } from "./shapes.mjs";

const length = 3;
const rise = 0.7;
const straightFrom = 2.1;
const half = 0.55;
const outletRadius = 0.5;
const noseAt = 1.95;
const noseRadius = 0.06;
const bodyRadius = 0.22;
const diagonals = [[1, -1], [1, 1], [-1, 1], [-1, -1]]; // prettier-ignore

const axisHeight = (x) => rise * smoothStep(Math.min(1, x / straightFrom));

const ductEdges = (builder) =>
  diagonals.map(([y, z], q) => {
    const places = [0, 0.15, 0.35, 0.55, 0.75, 0.9, 1].map((t) => {
      const reach = half + (outletRadius * Math.SQRT1_2 - half) * smoothStep(t);
      return [length * t, y * reach, axisHeight(length * t) + z * reach];
    });
    return builder.spline(places, `duct edge ${q + 1}`);
  });

const bodyRibs = (builder) =>
  diagonals.map(([y, z], q) => {
    const places = [0, 0.2, 0.45, 0.7, 1].map((t) => {
      const radius = noseRadius + (bodyRadius - noseRadius) * Math.sin((t * Math.PI) / 2);
      const reach = radius * Math.SQRT1_2;
      return [noseAt + (length - noseAt) * t, y * reach, rise + z * reach];
    });
    return builder.spline(places, `centrebody rib ${q + 1}`);
  });

function sDuct() {
  const builder = new ProjectBuilder();
  const inlet = square(builder, diagonals.map(([y, z]) => [0, y * half, z * half]), "inlet"); // prettier-ignore
  const outlet = circle(builder, [length, 0, rise], outletRadius, yAxis, zAxis, "outlet");
  const edges = ductEdges(builder);
  const nose = circle(builder, [noseAt, 0, rise], noseRadius, yAxis, zAxis, "nose");
  const hub = circle(builder, [length, 0, rise], bodyRadius, yAxis, zAxis, "hub");
  const ribs = bodyRibs(builder);
  builder.planar("inlet", turned(inlet));
  skin(builder, inlet, outlet, edges, "duct");
  builder.planar("nose", nose);
  skin(builder, nose, hub, ribs, "centrebody", false);
  builder.planar("outlet", outlet, hub);
  const stations = [
    { x: -0.2, size: 0.2 },
    { x: 1.1, size: 0.15 },
    { x: 1.95, size: 0.075 },
    { x: 3.2, size: 0.12 },
  ];
  boxRow(builder, stations, [-0.9, 0.9], [-0.8, 1.5]);
  return builder;
}

export const models = [
  {
    id: "s-duct",
    title: "S-duct",
    blurb: "An intake that rises from a square inlet to a round outlet, around a blunt centrebody.",
    group: "Curved patches",
    build: sDuct,
  },
];

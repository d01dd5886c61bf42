/** A swept wing on the wall of a wind tunnel, with elements stretched along its span. */
import { fanPrisms } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { box } from "./shapes.mjs";

const thickness = 0.14; // relative to the root chord
const span = 2;
const tipFrom = 0.7;
const tipTo = 1.15;
const tunnel = { low: [-1.3, 0, -1.2], high: [2.7, 2.8, 1.2] };
const stretched = { stretching: 4, direction: [tipFrom / 2, span, 0] };

/** Half the thickness of the NACA four-digit section, closed at the trailing edge. */
const halfThickness = (x) =>
  5 * thickness * (0.2969 * Math.sqrt(x) - 0.126 * x - 0.3516 * x ** 2 + 0.2843 * x ** 3 - 0.1036 * x ** 4);

const stations = [0, 0.01, 0.05, 0.12, 0.25, 0.42, 0.62, 0.82, 1];

/** One side of the wing's section between its leading and trailing edge at a fraction of the span. */
function section(builder, t, side, label) {
  const from = tipFrom * t;
  const chord = 1 + (tipTo - tipFrom - 1) * t;
  const places = stations.map((x) => [from + chord * x, span * t, side * chord * halfThickness(x)]);
  return builder.spline(places, `${label} ${side < 0 ? "lower" : "upper"} side`);
}

function wingInTunnel() {
  const builder = new ProjectBuilder();
  const [lower, upper] = [-1, 1].map((side) => section(builder, 0, side, "root"));
  const [tipLower, tipUpper] = [-1, 1].map((side) => section(builder, 1, side, "tip"));
  const leading = builder.straight([0, 0, 0], [tipFrom, span, 0], "leading edge");
  const trailing = builder.straight([1, 0, 0], [tipTo, span, 0], "trailing edge");
  builder.coons("wing lower side", [lower, trailing, -tipLower, -leading]);
  builder.coons("wing upper side", turned([upper, trailing, -tipUpper, -leading]));
  builder.planar("wing tip", [tipLower, -tipUpper]);
  box(builder, tunnel.low, tunnel.high, "tunnel", { holes: { front: [[upper, -lower]] } });
  const low = [tunnel.low[0] - 0.2, tunnel.low[2] - 0.2];
  const high = [tunnel.high[0] + 0.2, tunnel.high[2] + 0.2];
  const around = (y, inner, outer) => [
    { position: [0.45 + (tipFrom / span) * Math.min(y, span) * 0.7, y, 0], ...inner },
    ...[[0, 0], [1, 0], [1, 1], [0, 1]] // prettier-ignore
      .map(([i, k]) => ({ position: [i ? high[0] : low[0], y, k ? high[1] : low[1]], ...outer })),
  ];
  fanPrisms(builder, [
    around(-0.2, { size: 0.065, ...stretched }, { size: 0.42 }),
    around(span, { size: 0.065, ...stretched }, { size: 0.42 }),
    around(tunnel.high[1] + 0.2, { size: 0.25 }, { size: 0.42 }),
  ]);
  return builder;
}

export const models = [
  {
    id: "wing-in-a-tunnel",
    title: "Wing in a tunnel",
    blurb: "A swept wing on the wall of a wind tunnel; elements near it are stretched along its span.",
    group: "Background grid",
    build: wingInTunnel,
  },
];

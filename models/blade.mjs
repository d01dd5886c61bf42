/** A turbine blade: a cambered section that turns and tapers from its platform to the tip. */
import { boxRow } from "./background.mjs";
import { ProjectBuilder } from "./project-builder.mjs";
import { box, ruledRow, smoothStep, spread } from "./shapes.mjs";

const span = 2;
const twist = 55; // degrees, from the platform to the tip
const taper = 0.3; // of the chord
const camber = 0.14;
const edgeRadius = 0.06;
const fullness = 0.03; // half thickness added at mid chord

/** A position in the section: along the chord, and across it, from -1 to 1 of the half thickness. */
function onSection(s, side) {
  const slope = 4 * camber * (1 - 2 * s);
  const scale = 1 / Math.sqrt(1 + slope * slope);
  const half = edgeRadius + fullness * 4 * s * (1 - s);
  const height = 4 * camber * s * (1 - s) - camber / 2;
  return [s - 0.5 - side * half * slope * scale, height + side * half * scale];
}

/** Half a circle around an end of the chord, from one side of the camber line to the other. */
function edgeSection(end, fromSide) {
  const [first, last] = [onSection(end, fromSide), onSection(end, -fromSide)];
  const centre = [0, 1].map((k) => (first[k] + last[k]) / 2);
  const arm = [0, 1].map((k) => first[k] - centre[k]);
  // Seen from above, the section runs counter-clockwise, so the offset points to the left.
  return spread(0, 180, 5).map((degrees) => {
    const angle = (degrees * Math.PI) / 180;
    const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
    return [centre[0] + arm[0] * cosine - arm[1] * sine, centre[1] + arm[1] * cosine + arm[0] * sine];
  });
}

const along = [0, 0.12, 0.3, 0.5, 0.7, 0.88, 1];
const outline = {
  "pressure side": along.map((s) => onSection(s, -1)),
  "trailing edge": edgeSection(1, -1),
  "suction side": along.toReversed().map((s) => onSection(s, 1)),
  "leading edge": edgeSection(0, 1),
};

/** A position in the section, rotated and tapered as at fraction t of the span. */
function lifted([x, y], t) {
  const angle = (twist * smoothStep(t) * Math.PI) / 180;
  const scale = 1 - taper * t;
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  return [scale * (x * cosine - y * sine), scale * (x * sine + y * cosine), span * t];
}

function twistedBlade() {
  const builder = new ProjectBuilder();
  const names = Object.keys(outline);
  const section = (t, label) =>
    names.map((name) =>
      builder.spline(
        outline[name].map((place) => lifted(place, t)),
        `${label} ${name}`,
      ),
    );
  const root = section(0, "root");
  const tip = section(1, "tip");
  const seams = names.map((name) => {
    const places = spread(0, 1, 7).map((t) => lifted(outline[name][0], t));
    return builder.spline(places, `seam before the ${name}`);
  });
  ruledRow(builder, root, tip, seams, names);
  builder.planar("tip", tip);
  box(builder, [-0.85, -0.55, -0.25], [0.85, 0.55, 0], "platform", { holes: { top: [root] } });
  boxRow(
    builder,
    [
      { x: -1, size: 0.1 },
      { x: 0, size: 0.075 },
      { x: 1, size: 0.1 },
    ],
    [-0.8, 0.8],
    [-0.4, 2.2],
  );
  return builder;
}

export const models = [
  {
    id: "twisted-blade",
    title: "Twisted blade",
    blurb: "A cambered blade that turns by 55° from its platform to the tip: Coons patches between splines.",
    group: "Curved patches",
    build: twistedBlade,
  },
];

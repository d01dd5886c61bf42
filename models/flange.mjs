/** A pipe flange of circles, arcs and tubes. */
import { uniform } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { onCircle, xAxis, yAxis } from "./shapes.mjs";

const radii = { bore: 0.3, pipe: 0.5, hub: 0.62, bolt: 0.12, bolts: 0.88, flange: 1.15 };
const heights = { plate: 0.3, hub: 0.6, pipe: 1.3 };
const boltCount = 6;

/** Returns the loop of one circle, counter-clockwise as seen from above. */
function circle(builder, centre, radius, name) {
  const [a, b, c] = [0, 120, 240].map((degrees) => onCircle(centre, radius, xAxis, yAxis, degrees));
  return [builder.line("circle", [a, b, c, a], name)];
}

/** Returns the loop of two half circles. */
function halves(builder, z, radius, name) {
  return [0, 180].map((start, i) => {
    const places = [0, 90, 180].map((turn) => onCircle([0, 0, z], radius, xAxis, yAxis, start + turn));
    return builder.line("arc", places, `${name} ${i + 1}`);
  });
}

function flange() {
  const builder = new ProjectBuilder();
  const { plate, hub, pipe } = heights;
  const tube = (name, low, high) => builder.patch("tube", name, low, high);
  const bolts = Array.from({ length: boltCount }, (_, i) => {
    const [x, y] = onCircle([0, 0, 0], radii.bolts, xAxis, yAxis, (360 / boltCount) * (i + 0.5));
    return [0, plate].map((z) => circle(builder, [x, y, z], radii.bolt, `bolt hole ${i + 1}`));
  });
  const [lowRim, highRim] = [0, plate].map((z) => halves(builder, z, radii.flange, "rim"));
  const [lowBore, highBore] = [0, pipe].map((z) => circle(builder, [0, 0, z], radii.bore, "bore"));
  const hubFoot = circle(builder, [0, 0, plate], radii.hub, "foot of the hub");
  const hubTop = circle(builder, [0, 0, hub], radii.pipe, "top of the hub");
  const pipeEnd = circle(builder, [0, 0, pipe], radii.pipe, "end of the pipe");

  builder.planar("sealing face", turned(lowRim), lowBore, ...bolts.map(([low]) => low));
  builder.planar("bolt face", highRim, hubFoot, ...bolts.map(([, high]) => high));
  builder.planar("pipe end", pipeEnd, highBore);
  // From low to high, a tube faces away from its axis; from high to low, towards it.
  tube("rim", lowRim, highRim);
  tube("hub", hubFoot, hubTop);
  tube("pipe", hubTop, pipeEnd);
  tube("bore", highBore, lowBore);
  bolts.forEach(([low, high], i) => tube(`bolt hole ${i + 1}`, high, low));
  uniform(builder, [-2, -2, -1], 12, 0.085);
  return builder;
}

export const models = [
  {
    id: "pipe-flange",
    title: "Pipe flange",
    blurb: "Circles and arcs, joined by tubes: cylinders, a cone and six bolt holes, all exact.",
    group: "Curved patches",
    build: flange,
  },
];

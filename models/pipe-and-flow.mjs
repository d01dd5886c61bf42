/** A pipe and the flow inside: two regions with an interface. */
import { uniform } from "./background.mjs";
import { ProjectBuilder, turned } from "./project-builder.mjs";
import { circle, quarters, skin, yAxis, zAxis } from "./shapes.mjs";

const length = 2;
const radii = { inner: 0.34, outer: 0.5 };

function pipeAndFlow() {
  const builder = new ProjectBuilder();
  const sectionsOf = (radius, label) =>
    [0, length].map((x) => circle(builder, [x, 0, 0], radius, yAxis, zAxis, label));
  const startOf = (line) => {
    const { points } = builder.lines[Math.abs(line) - 1];
    return builder.points[points[0] - 1].position;
  };
  const tube = (sections, label) => {
    const [first, last] = sections;
    const along = quarters.map((q) => builder.straight(startOf(first[q]), startOf(last[q]), `${label} line`));
    skin(builder, first, last, along, label);
  };
  const inner = sectionsOf(radii.inner, "inner");
  const outer = sectionsOf(radii.outer, "outer");
  tube(inner, "wall");
  tube(outer, "outside");
  // Counter-clockwise as seen against the x axis, so the far ends face outward already.
  [
    ["inlet", turned],
    ["outlet", (loop) => loop],
  ].forEach(([label, outward], end) => {
    builder.planar(`${label} of the flow`, outward(inner[end]));
    builder.planar(`${label} rim`, outward(outer[end]), inner[end]);
  });
  uniform(builder, [-1, -1, -1], 8, 0.09);
  return builder;
}

export const models = [
  {
    id: "pipe-and-flow",
    title: "Pipe and flow",
    blurb:
      "Two regions, fluid inside metal: they share the four patches between them, so their meshes match.",
    group: "Regions and cavities",
    build: pipeAndFlow,
  },
];

import { LIMITS, limitText } from "../base/limits.js";
import { MESH_DEFAULTS, SOURCE_GROWTH } from "../generated/constants.js";

const LENGTH = limitText(LIMITS.length);

/** Descriptions of the fields of a project. Only the JSON Schema uses them; the bundle for pages omits them. */
export const WORDS = {
  id: "Whole number above 0, unique among entities of the same kind",
  name: "Name given by the user",
  position: "x y z, in model units",
  linePoints:
    "Point ids along the line: two for a straight line; start, middle and end of a parabola; four or more for a spline, which is closed if the last equals the first",
  loop: "Line ids in order; a negative id traverses its line from the last point to the first",
  patchType: "In barnhill-gregory-nielson, the loop's second line is weighted differently from the others",
  loops: "Outer loop first, then holes",
  nodeSize: `Target edge length in model units, above 0, up to ${LENGTH}`,
  stretching: "Target edge length along `direction`, divided by `size`; 1 to 1e6",
  direction: "Direction of stretching; any length except 0",
  positions: "Corners: one for a point, two for a segment, three for a triangle",
  sourceSize: `Target edge length at the source, in model units, above 0, up to ${LENGTH}`,
  distance: `Distance from the source up to which \`size\` applies; 0 to ${LENGTH}, default 0`,
  growth: `Growth of the size per unit of distance beyond \`distance\`; 0 to ${LIMITS.growth}, default ${SOURCE_GROWTH}`,
  tetrahedra: "Four node ids per tetrahedron, in either orientation",
  sources: "Points, segments and triangles that limit the element size around them",
  coverageMargin:
    "Positions up to this distance outside the grid count as covered; a fraction of the longest edge of the nearest tetrahedron",
  size: `Uniform size in model units that replaces the background grid, above 0, up to ${LENGTH}; sources still apply`,
  gradation: `Largest size ratio of neighbouring elements, above 1, up to ${LIMITS.gradation}; 0 for no limit; default ${MESH_DEFAULTS.gradation}`,
  innerShells:
    "What closed shells inside a region bound: cavities (default), or regions, which are meshed too",
  order: "Next face of the front: one of the lowest layer (default), or the smallest",
  optimization: "Effort spent on improving the elements after the front",
  schema: "Schema for editors; ignored when the file is read",
  units: 'Label such as "mm"; nothing is converted',
  meshing: "Default mesh settings; options of the caller take precedence",
  background: "Coarse tetrahedra that cover the model, with the target size at their nodes",
} as const;

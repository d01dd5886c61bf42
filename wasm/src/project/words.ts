/** What the fields of a project mean, for the JSON Schema alone: the bundle for pages leaves them out. */
export const WORDS = {
  id: "Unique among its kind; a whole number above 0",
  name: "What the user calls it",
  position: "x y z, in model units",
  linePoints:
    "Point ids along the line: two; start, middle, end; or four and more, closed if it ends where it begins",
  loop: "Line ids in walking order; a negative id walks that line backwards",
  patchType: "Of barnhill-gregory-nielson, the loop's second line plays another role than the rest",
  loops: "The outer loop first, then holes",
  nodeSize: "Wanted edge length, in model units, above 0, up to 1e30",
  stretching: "Length along `direction` divided by `size`, 1 to 1e6",
  direction: "Stretching direction; any length but 0",
  positions: "Corners: one of a point, two of a segment, three of a triangle",
  sourceSize: "Wanted edge length there, in model units, above 0, up to 1e30",
  distance: "Up to this far away `size` holds too; 0 to 1e30, 0 if not given",
  growth: "Of the size per unit of distance beyond; 0 to 10, 0.3 if not given",
  tetrahedra: "Four node ids each, in any orientation",
  sources: "Positions around which elements are to be no larger than a size",
  coverageMargin:
    "What this far outside still counts as covered, as a share of the nearest tetrahedron's longest edge",
  size: "One wanted edge length everywhere, in model units, above 0, up to 1e30: in place of the background grid's; sources still hold",
  gradation:
    "Most by which sizes grow from one element to the next, above 1, up to 10; 0 takes them as they are; 1.3 if not given",
  innerShells:
    "What closed patches within a body bound: cavities, if not given, or regions that are meshed too",
  order: "Which face of the front comes next: of the lowest layer, if not given, or the smallest",
  optimization: "Effort on the elements after the front; default, if not given",
  schema: "For editors; not interpreted",
  units: 'A label such as "mm"; nothing is converted',
  meshing: "How it is to be meshed, where whoever meshes it does not say",
  background: "Coarse tetrahedra covering the model, with the wanted size at their nodes",
} as const;

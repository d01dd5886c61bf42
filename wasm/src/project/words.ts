import { LIMITS, limitText } from "../base/limits.js";
import {
  MAX_LAYERS,
  MAX_REMESH_ANGLE,
  MESH_DEFAULTS,
  REMESH_DEFAULTS,
  SOURCE_GROWTH,
} from "../generated/constants.js";

const LENGTH = limitText(LIMITS.length);

/** Descriptions of the fields of a project. Only the JSON Schema uses them; the bundle for pages omits them. */
export const WORDS = {
  id: "Whole number above 0, unique among entities of the same kind",
  name: "Name given by the user",
  position: "x y z, in model units",
  linePoints:
    "Point ids along the line: two for a straight line; start, middle and end of a parabola; start, a point between and end of an arc; three points of a circle and the first again; three or more for a spline, or four or more if the last equals the first, which closes it; two or more for a Hermite line",
  startTangent: "Tangent at the start of a spline or Hermite line, in its direction; any length except 0",
  endTangent: "Tangent at the end of a spline or Hermite line, in its direction; any length except 0",
  loop: "Line ids in order; a negative id traverses its line from the last point to the first",
  patchType:
    "In barnhill-gregory-nielson, the loop's second line is weighted differently from the others; a tube joins two loops by straight rulings; gregory and nielson join other patches smoothly",
  loops:
    "Outer loop first, then holes; the two rims of a tube; after the outer loop of a loft, its sections, one line each",
  nodeSize: `Target edge length in model units, above 0, up to ${LENGTH}`,
  stretching: "Target edge length along `direction`, divided by `size`; 1 to 1e6",
  direction: "Direction of stretching; any length except 0",
  secondStretching: "Target edge length along `secondDirection`, divided by `size`; 1 to 1e6",
  secondDirection: "Direction of the second stretching, orthogonal to `direction`; any length except 0",
  positions: "Corners: one for a point, two for a segment, three for a triangle",
  sourceSize: `Target edge length at the source, in model units, above 0, up to ${LENGTH}`,
  distance: `Distance from the source up to which \`size\` applies; 0 to ${LENGTH}, default 0`,
  growth: `Growth of the size per unit of distance beyond \`distance\`; 0 to ${LIMITS.growth}, default ${SOURCE_GROWTH}`,
  sourceBody: "Id of the body that the source was painted on; the app moves the source with it",
  tetrahedra: "Four node ids per tetrahedron, in either orientation",
  sources: "Points, segments and triangles that limit the element size around them",
  coverageMargin:
    "Positions up to this distance outside the grid count as covered; a fraction of the longest edge of the nearest tetrahedron",
  size: `Uniform size in model units that replaces the background grid, above 0, up to ${LENGTH}; sources still apply`,
  elements:
    "Number of elements that the mesh is to have: all sizes are multiplied by the factor with which it is reached within 5 %",
  gradation: `Largest size ratio of neighbouring elements, above 1, up to ${LIMITS.gradation}; 0 for no limit; default ${MESH_DEFAULTS.gradation}`,
  innerShells:
    "What closed shells inside a region bound: cavities, or regions, which are meshed too; by default (by-orientation), regions if their triangles face the same way as those around them",
  order:
    "Next face of the front: one of the lowest layer (default), the smallest, the first in, or a random one",
  optimization: "Effort spent on improving the elements after the front",
  interior:
    "What fills the deep inside: the front; lattices, where sizes are nearly constant over some elements; or (auto, the default) lattices in large meshes",
  bodies: "Closed triangulated surfaces beside the drawn patches",
  bodyPoints: "Nodes of the given triangles: base64 of x y z per node, as little-endian doubles",
  bodyTriangles: "Given triangles: base64 of three node indices each, as little-endian 32-bit integers",
  failures: "The features that were left out, and why",
  isOutdated: "Whether the features were changed after the triangles were made of them",
  features:
    "The list of features from which the solid is made: pieces that are joined, cut or intersected, and changes such as fillets. Lengths in model units, angles in degrees",
  patchOrigin: "The face of a feature from which the patch comes, such as 3/top: the top of feature 3",
  trueFaces:
    "The faces of the CAD file of the body, in base64: nodes of a remeshed surface are placed on them. Made by readers of CAD files",
  trianglePatch:
    "Base64 of the index in `patches` of each triangle, as little-endian 32-bit integers; may be omitted if there is one patch",
  patchSolid: "Name of the solid that the patch bounds, in a body of several solids",
  patchColor: "Red, green and blue from 0 to 1, in sRGB, as in the file of the body",
  bodyPatches: "Patches of the body; their ids differ from those of all other patches of the project",
  bodySurface:
    "What is done to the given triangles before the body is filled: remesh (default), refine (split large triangles), or keep",
  remeshing: "How the surface is remeshed",
  remeshSize: `Target edge length in model units, above 0, up to ${LENGTH}; default: the sizes of the project, else by shape`,
  minSize: "Smallest size that the shape may ask for, in model units",
  maxSize: "Largest automatic size, in model units",
  tolerance: "Largest distance between the given and the new surface, in model units",
  featureAngle: `Edges with a larger angle between their triangles stay sharp; 1 to ${MAX_REMESH_ANGLE} degrees, default ${REMESH_DEFAULTS.featureAngle}`,
  anglePerEdge: `Largest angle that an edge may span on a curved patch; 1 to ${MAX_REMESH_ANGLE} degrees`,
  layers: `Number of elements across thin walls, 0 to ${MAX_LAYERS}; 0 ignores thickness`,
  dropDetails:
    "Details below this length are dropped first, in model units; 0 keeps all; default: those below a fifth of the tolerance, and more that leave poor triangles",
  remeshGrowth: `Growth of the size per unit of distance, 0 to ${LIMITS.growth}, default ${REMESH_DEFAULTS.growth}`,
  placement: "Where the body is: the given points are scaled, then rotated, then moved",
  repairDeviation:
    "Largest distance by which the repairs moved a node, summed over repairs, in the coordinates of the given points; for information",
  repairs: "What repairs have changed in the given surface; for information",
  repairKind: "Kind of the changes",
  repairCount: "Number of changes of this kind",
  repairPositions: "Positions of the first changes, in the coordinates of the given points",
  bodyPosition: "Position of the origin of the given points: x y z in model units, default 0 0 0",
  rotation: "Unit quaternion x y z w, default 0 0 0 1",
  scale: `Factor above 0, up to ${LENGTH}; default 1`,
  schema: "Schema for editors; ignored when the file is read",
  units: 'Label such as "mm"; nothing is converted',
  meshing: "Default mesh settings; options of the caller take precedence",
  groups: "Named sets of entities; meshing ignores them",
  groupName: "Name of the group",
  groupColor: "Red, green and blue from 0 to 1, in sRGB",
  members: "Kinds and ids of the members; a patch may be drawn or belong to a body",
  parameters: "Named numbers that expressions use",
  parameterName: "Letters, digits and underscores, not beginning with a digit; unique",
  parameterExpression: "A number, or a formula with other parameters, such as 2*radius",
  expressions: "What numbers of entities and mesh settings are computed from; the values are there",
  expressionField:
    "Path of the number in the entity, such as position.0 or size; features.3.radius is a number of the feature 3 of a body",
  meshingField: "Name of the number in the mesh settings",
  expression: "A formula with parameters, such as radius/2",
  problem: "Problem that a solver solves on the mesh; meshing ignores it",
  conductivity: "Of heat, above 0, default 1",
  diffusivity: "Of advection, above 0, default 0.01",
  velocity: "Of advection, default 1 0 0",
  volumeSource: "Per unit of volume, default 0",
  youngsModulus: "Of elasticity, above 0, default 210000",
  poissonRatio: "Of elasticity, above -1 and below 0.5, default 0.3",
  conditions: "Conditions on patches",
  conditionPatch: "Id of the patch, drawn or of a body",
  conditionValue: "Temperature, concentration, or inward flux per unit of area; default 0",
  traction: "Force per unit of area, default 0 0 0",
  background: "Coarse tetrahedra that cover the model, with the target size at their nodes",
} as const;

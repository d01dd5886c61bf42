/** Writes STEP files of solids with plane and cylindrical faces: exact boundaries, names, colours, units. */

type Triple = readonly [number, number, number];

/** Edge between two corners: straight, or a full circle, which begins and ends at the same corner. */
interface Edge {
  readonly from: number;
  readonly to: number;
  readonly circle?: Placement & { readonly radius: number };
}

interface Placement {
  readonly origin: Triple;
  readonly axis: Triple;
  readonly x: Triple;
}

interface Face {
  readonly surface: Placement & { readonly radius?: number };
  /** Numbers of edges from 1, negative for those that are passed backwards. */
  readonly loops: readonly (readonly number[])[];
  /** Whether the outside is where the surface's own normal points. */
  readonly isForward?: boolean;
  readonly color?: Triple;
}

export interface StepSolid {
  readonly name: string;
  readonly color?: Triple;
  readonly corners: readonly Triple[];
  readonly edges: readonly Edge[];
  readonly faces: readonly Face[];
}

const X: Triple = [1, 0, 0];
const Z: Triple = [0, 0, 1];

/** Returns a box. Its faces are those of the lowest x, highest x, and so on for y and z; `colors` are theirs. */
export function boxSolid(
  name: string,
  low: Triple,
  high: Triple,
  { color, colors = [] }: { readonly color?: Triple; readonly colors?: readonly (Triple | undefined)[] } = {},
): StepSolid {
  const corners = Array.from({ length: 8 }, (_, c): Triple => {
    const at = (axis: 0 | 1 | 2) => ((c >> axis) & 1 ? high[axis] : low[axis]);
    return [at(0), at(1), at(2)];
  });
  const edges: Edge[] = [];
  const edgeOf = (from: number, to: number): number => {
    const known = edges.findIndex(
      (edge) => edge.from === Math.min(from, to) && edge.to === Math.max(from, to),
    );
    const index = known >= 0 ? known : edges.push({ from: Math.min(from, to), to: Math.max(from, to) }) - 1;
    return from < to ? index + 1 : -index - 1;
  };
  const loops = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
  ];
  const faces = loops.map((loop, f): Face => {
    const axis = Math.floor(f / 2);
    const normal = [0, 1, 2].map((i) => (i === axis ? (f % 2 === 0 ? -1 : 1) : 0)) as unknown as Triple;
    const own = colors[f];
    return {
      surface: { origin: corners[loop[0] ?? 0] ?? low, axis: normal, x: axis === 0 ? [0, 1, 0] : X },
      loops: [loop.map((corner, i) => edgeOf(corner, loop[(i + 1) % 4] ?? 0))],
      ...(own && { color: own }),
    };
  });
  return { name, ...(color && { color }), corners, edges, faces };
}

/** Returns a box with a round hole from its lowest to its highest z: its seventh face. */
export function drilledSolid(
  name: string,
  low: Triple,
  high: Triple,
  [x, y]: readonly [number, number],
  radius: number,
): StepSolid {
  const box = boxSolid(name, low, high);
  const circle = (z: number) => ({ origin: [x, y, z] as const, axis: Z, x: X, radius });
  const [bottom, top] = [box.corners.length, box.corners.length + 1];
  const edges: Edge[] = [
    ...box.edges,
    { from: bottom, to: bottom, circle: circle(low[2]) },
    { from: top, to: top, circle: circle(high[2]) },
    { from: bottom, to: top },
  ];
  const [below, above, seam] = [edges.length - 2, edges.length - 1, edges.length];
  const faces = box.faces.map((face, f) => {
    if (f < 4) return face;
    return { ...face, loops: [...face.loops, [f === 4 ? below : -above]] };
  });
  const wall: Face = {
    surface: { origin: [x, y, low[2]], axis: Z, x: X, radius },
    loops: [[-below, seam, above, -seam]],
    isForward: false,
  };
  const corners = [...box.corners, [x + radius, y, low[2]] as const, [x + radius, y, high[2]] as const];
  return { name, corners, edges, faces: [...faces, wall] };
}

/** Returns a round pin with its axis along z; its faces are the wall, the bottom and the top. */
export function pinSolid(name: string, [x, y, z]: Triple, radius: number, height: number): StepSolid {
  const circle = (at: number) => ({ origin: [x, y, at] as const, axis: Z, x: X, radius });
  return {
    name,
    corners: [
      [x + radius, y, z],
      [x + radius, y, z + height],
    ],
    edges: [
      { from: 0, to: 0, circle: circle(z) },
      { from: 1, to: 1, circle: circle(z + height) },
      { from: 0, to: 1 },
    ],
    faces: [
      { surface: { origin: [x, y, z], axis: Z, x: X, radius }, loops: [[1, 3, -2, -3]] },
      { surface: { origin: [x, y, z], axis: [0, 0, -1], x: X }, loops: [[-1]] },
      { surface: { origin: [x, y, z + height], axis: Z, x: X }, loops: [[2]] },
    ],
  };
}

const UNITS = {
  mm: "(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.))",
  m: "(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.))",
  inch: "",
} as const;

/** Writes the entities of a file and numbers them. */
class Entities {
  readonly lines: string[] = [];

  add(text: string): string {
    this.lines.push(`#${this.lines.length + 1} = ${text};`);
    return `#${this.lines.length}`;
  }

  point([x, y, z]: Triple): string {
    return this.add(`CARTESIAN_POINT('',(${[x, y, z].map(real).join()}))`);
  }

  direction(parts: Triple): string {
    return this.add(`DIRECTION('',(${parts.map(real).join()}))`);
  }

  placement({ origin, axis, x }: Placement): string {
    return this.add(
      `AXIS2_PLACEMENT_3D('',${this.point(origin)},${this.direction(axis)},${this.direction(x)})`,
    );
  }
}

const real = (value: number): string =>
  (Number.isInteger(value) ? `${value}.` : `${value}`).replace("e", "E");
const bool = (isTrue: boolean): string => (isTrue ? ".T." : ".F.");

/** Returns a STEP file (AP214) in which each solid is a product of its own. */
export function stepFile(solids: readonly StepSolid[], unit: keyof typeof UNITS = "mm"): Uint8Array {
  const file = new Entities();
  const application = file.add("APPLICATION_CONTEXT('automotive design')");
  file.add(
    `APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,${application})`,
  );
  const context = contextIn(file, unit);
  for (const solid of solids) addProduct(file, solid, application, context);
  const header =
    "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n" +
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n";
  return new TextEncoder().encode(`${header}${file.lines.join("\n")}\nENDSEC;\nEND-ISO-10303-21;\n`);
}

function contextIn(file: Entities, unit: keyof typeof UNITS): string {
  const millimetre = file.add(UNITS.mm);
  const length =
    unit === "inch" ? inchIn(file, millimetre) : unit === "mm" ? millimetre : file.add(UNITS[unit]);
  const angle = file.add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))");
  const solidAngle = file.add("(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT())");
  const error = file.add(
    `UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),${length},'distance_accuracy_value','')`,
  );
  return file.add(
    `(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((${error})) GLOBAL_UNIT_ASSIGNED_CONTEXT((${length},${angle},${solidAngle})) REPRESENTATION_CONTEXT('','3D'))`,
  );
}

function inchIn(file: Entities, millimetre: string): string {
  const measure = file.add(`LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),${millimetre})`);
  const dimensions = file.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
  return file.add(`(CONVERSION_BASED_UNIT('INCH',${measure}) LENGTH_UNIT() NAMED_UNIT(${dimensions}))`);
}

function addProduct(file: Entities, solid: StepSolid, application: string, context: string): void {
  const productContext = file.add(`PRODUCT_CONTEXT('',${application},'mechanical')`);
  const product = file.add(`PRODUCT('${solid.name}','${solid.name}','',(${productContext}))`);
  const formation = file.add(`PRODUCT_DEFINITION_FORMATION('','',${product})`);
  const definitionContext = file.add(`PRODUCT_DEFINITION_CONTEXT('part definition',${application},'design')`);
  const definition = file.add(`PRODUCT_DEFINITION('design','',${formation},${definitionContext})`);
  const shape = file.add(`PRODUCT_DEFINITION_SHAPE('','',${definition})`);
  const origin = file.placement({ origin: [0, 0, 0], axis: Z, x: X });
  const { brep, faces } = addSolid(file, solid);
  const representation = file.add(`ADVANCED_BREP_SHAPE_REPRESENTATION('',(${origin},${brep}),${context})`);
  file.add(`SHAPE_DEFINITION_REPRESENTATION(${shape},${representation})`);
  const styled = [
    ...(solid.color ? [styledIn(file, brep, solid.color)] : []),
    ...solid.faces.flatMap(({ color }, f) => (color ? [styledIn(file, faces[f] ?? "", color)] : [])),
  ];
  if (styled.length > 0)
    file.add(`MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(${styled.join()}),${context})`);
}

function addSolid(
  file: Entities,
  { name, corners, edges, faces }: StepSolid,
): { readonly brep: string; readonly faces: readonly string[] } {
  const vertices = corners.map((corner) => file.add(`VERTEX_POINT('',${file.point(corner)})`));
  const curves = edges.map(({ from, to, circle }) => {
    const curve = circle
      ? file.add(`CIRCLE('',${file.placement(circle)},${real(circle.radius)})`)
      : lineIn(file, corners[from] ?? [0, 0, 0], corners[to] ?? [0, 0, 0]);
    return file.add(`EDGE_CURVE('',${vertices[from]},${vertices[to]},${curve},.T.)`);
  });
  const made = faces.map(({ surface, loops, isForward = true }) => {
    const bounds = loops.map((loop, l) => {
      const oriented = loop.map((edge) =>
        file.add(`ORIENTED_EDGE('',*,*,${curves[Math.abs(edge) - 1]},${bool(edge > 0)})`),
      );
      const ring = file.add(`EDGE_LOOP('',(${oriented.join()}))`);
      return file.add(`${l === 0 ? "FACE_OUTER_BOUND" : "FACE_BOUND"}('',${ring},.T.)`);
    });
    const placement = file.placement(surface);
    const plane =
      surface.radius === undefined
        ? file.add(`PLANE('',${placement})`)
        : file.add(`CYLINDRICAL_SURFACE('',${placement},${real(surface.radius)})`);
    return file.add(`ADVANCED_FACE('',(${bounds.join()}),${plane},${bool(isForward)})`);
  });
  const shell = file.add(`CLOSED_SHELL('',(${made.join()}))`);
  return { brep: file.add(`MANIFOLD_SOLID_BREP('${name}',${shell})`), faces: made };
}

function lineIn(file: Entities, from: Triple, to: Triple): string {
  const along: Triple = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  const length = Math.sqrt(along[0] ** 2 + along[1] ** 2 + along[2] ** 2);
  const direction = file.direction([along[0] / length, along[1] / length, along[2] / length]);
  return file.add(`LINE('',${file.point(from)},${file.add(`VECTOR('',${direction},1.)`)})`);
}

function styledIn(file: Entities, item: string, color: Triple): string {
  const rgb = file.add(`COLOUR_RGB('',${color.map(real).join()})`);
  const fill = file.add(`FILL_AREA_STYLE('',(${file.add(`FILL_AREA_STYLE_COLOUR('',${rgb})`)}))`);
  const side = file.add(`SURFACE_SIDE_STYLE('',(${file.add(`SURFACE_STYLE_FILL_AREA(${fill})`)}))`);
  const usage = file.add(`SURFACE_STYLE_USAGE(.BOTH.,${side})`);
  const style = file.add(`PRESENTATION_STYLE_ASSIGNMENT((${usage}))`);
  return file.add(`STYLED_ITEM('color',(${style}),${item})`);
}

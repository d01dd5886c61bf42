const decimals = 6;
const round = (value) => Number(value.toFixed(decimals)) + 0;
const rounded = (at) => at.map(round);

/** The same loop in the other direction. A patch is drawn counter-clockwise as seen from outside. */
export const turned = (loop) => loop.toReversed().map((step) => -step);

/**
 * Collects the entities of a project under consecutive ids. Equal points and equal lines are made once, so patches
 * that touch share them. Coordinates are rounded: the files are easy to read, and the result does not depend on
 * the platform's sine.
 */
export class ProjectBuilder {
  points = [];
  lines = [];
  patches = [];
  nodes = [];
  tetrahedra = [];
  sources = [];
  /** Options of a run, as in the project file; none by default. */
  meshing;
  #pointOf = new Map();
  #lineOf = new Map();

  point(at, name) {
    const place = rounded(at);
    const key = place.join(" ");
    let id = this.#pointOf.get(key);
    if (id === undefined) {
      id = this.points.length + 1;
      this.#pointOf.set(key, id);
      this.points.push({ id, ...(name && { name }), position: place });
    }
    return id;
  }

  /** Returns the id of the line through these positions, negative if it was drawn in the other direction. */
  line(type, places, name) {
    const ids = places.map((at) => this.point(at));
    const forward = this.#lineOf.get(ids.join(" "));
    if (forward !== undefined) return forward;
    const backward = this.#lineOf.get(ids.toReversed().join(" "));
    if (backward !== undefined) return -backward;
    const id = this.lines.length + 1;
    this.#lineOf.set(ids.join(" "), id);
    this.lines.push({ id, ...(name && { name }), type, points: ids });
    return id;
  }

  straight(from, to, name) {
    return this.line("straight", [from, to], name);
  }

  spline(places, name) {
    return this.line("spline", places, name);
  }

  parabola(from, middle, to, name) {
    return this.line("parabolic", [from, middle, to], name);
  }

  /** Returns the straight lines of a closed polygon. */
  polygon(places, label) {
    return places.map((at, i) =>
      this.straight(at, places[(i + 1) % places.length], label && `${label} ${i + 1}`),
    );
  }

  patch(type, name, ...loops) {
    this.patches.push({ id: this.patches.length + 1, name, type, loops });
  }

  planar(name, ...loops) {
    this.patch("planar", name, ...loops);
  }

  coons(name, ...loops) {
    this.patch("coons", name, ...loops);
  }

  /** Adds a node of the background grid; `more` may give its stretching and direction. */
  node(at, size, more = {}) {
    const id = this.nodes.length + 1;
    this.nodes.push({ id, position: rounded(at), size: round(size), ...more });
    return id;
  }

  tetrahedron(...nodes) {
    this.tetrahedra.push(nodes);
  }

  /** Adds a source at one, two or three positions (a point, a segment, a triangle). */
  source(name, places, size, more = {}) {
    const type = ["point", "segment", "triangle"][places.length - 1];
    this.sources.push({
      id: this.sources.length + 1,
      name,
      type,
      positions: places.map(rounded),
      size: round(size),
      ...more,
    });
  }

  /** Returns the text of the project file, one entity per line. */
  toText(name, description) {
    const row = (entity) => `    ${JSON.stringify(entity)}`;
    const list = (entities) => `[\n${entities.map(row).join(",\n")}\n  ]`;
    const inner = (entities) => list(entities).replaceAll("\n", "\n  ");
    const sources = this.sources.length > 0 ? `,\n    "sources": ${inner(this.sources)}` : "";
    const meshing = this.meshing ? `,\n  "meshing": ${JSON.stringify(this.meshing)}` : "";
    return `{
  "format": "tetrafront-project",
  "version": 2,
  "name": ${JSON.stringify(name)},
  "description": ${JSON.stringify(description)},
  "units": "m",
  "points": ${list(this.points)},
  "lines": ${list(this.lines)},
  "patches": ${list(this.patches)},
  "background": {
    "nodes": ${inner(this.nodes)},
    "tetrahedra": ${inner(this.tetrahedra)}${sources}
  }${meshing}
}
`;
  }
}

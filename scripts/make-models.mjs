/**
 * Writes the sample projects of public/models. Run it after changing a shape:
 * `node scripts/make-models.mjs`. Coordinates are rounded, so that the files read well and the
 * result does not depend on the platform's sine.
 */
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import path from "node:path";

const modelsFolder = path.join(path.dirname(fileURLToPath(import.meta.url)), "../public/models");
const decimals = 6;
const round = (value) => Number(value.toFixed(decimals)) + 0;

/** Collects points, lines and patches under running ids; equal points and lines are made once. */
class Builder {
  points = [];
  lines = [];
  patches = [];
  nodes = [];
  tetrahedra = [];
  #pointOf = new Map();
  #lineOf = new Map();

  point(at, name) {
    const rounded = at.map(round);
    const key = rounded.join(" ");
    let id = this.#pointOf.get(key);
    if (id === undefined) {
      id = this.points.length + 1;
      this.#pointOf.set(key, id);
      this.points.push({ id, ...(name && { name }), at: rounded });
    }
    return id;
  }

  /** The id of the line through these places, negative if it was drawn the other way round. */
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

  patch(type, name, ...loops) {
    this.patches.push({ id: this.patches.length + 1, name, type, loops });
  }

  /**
   * A row of boxes along x, each of six tetrahedra around its diagonal. Every station is
   * { x, size }, and the boxes reach over the given ranges of y and z.
   */
  backgroundRow(stations, [y0, y1], [z0, z1]) {
    for (const { x, size } of stations) {
      for (const z of [z0, z1]) {
        for (const y of [y0, y1]) this.nodes.push({ id: this.nodes.length + 1, at: [x, y, z], size });
      }
    }
    const walks = [[1, 2, 4], [1, 4, 2], [2, 1, 4], [2, 4, 1], [4, 1, 2], [4, 2, 1]]; // prettier-ignore
    const corner = (cell, code) => 1 + 4 * (cell + (code & 1)) + (code >> 1);
    for (let cell = 0; cell + 1 < stations.length; ++cell) {
      for (const [a, b, c] of walks) {
        this.tetrahedra.push([0, a, a + b, a + b + c].map((code) => corner(cell, code)));
      }
    }
  }

  write(file, name, description) {
    const row = (entity) => `    ${JSON.stringify(entity)}`;
    const list = (entities) => `[\n${entities.map(row).join(",\n")}\n  ]`;
    const text = `{
  "format": "tetrafront-project",
  "version": 1,
  "name": ${JSON.stringify(name)},
  "description": ${JSON.stringify(description)},
  "units": "m",
  "points": ${list(this.points)},
  "lines": ${list(this.lines)},
  "patches": ${list(this.patches)},
  "background": {
    "nodes": ${list(this.nodes).replaceAll("\n", "\n  ")},
    "tetrahedra": ${list(this.tetrahedra).replaceAll("\n", "\n  ")}
  }
}
`;
    writeFileSync(path.join(modelsFolder, file), text);
  }
}

/** Places on a circle around a centre, in the plane of two unit axes, from one angle to another. */
const arc = (centre, radius, across, up, fromDegrees, toDegrees, count) =>
  Array.from({ length: count }, (_, i) => {
    const angle = ((fromDegrees + ((toDegrees - fromDegrees) * i) / (count - 1)) * Math.PI) / 180;
    return centre.map((c, k) => c + radius * (Math.cos(angle) * across[k] + Math.sin(angle) * up[k]));
  });

const xAxis = [1, 0, 0];
const yAxis = [0, 1, 0];
const zAxis = [0, 0, 1];
const quarters = [0, 1, 2, 3];
const next = (quarter) => (quarter + 1) % 4;

/** The same loop walked the other way: a patch is drawn counter-clockwise seen from outside. */
const turned = (loop) => loop.toReversed().map((step) => -step);

/** Four lines of a closed section, one per quarter, beginning on the diagonal below right. */
const circle = (builder, centre, radius, across, up, label) =>
  quarters.map((q) =>
    builder.line(
      "spline",
      arc(centre, radius, across, up, 90 * q - 45, 90 * q + 45, 5),
      `${label} arc ${q + 1}`,
    ),
  );

const square = (builder, corners, label) =>
  quarters.map((q) => builder.line("straight", [corners[q], corners[next(q)]], `${label} edge ${q + 1}`));

/**
 * Four Coons patches between two closed sections joined by four lengthwise lines; the material lies
 * inside them, or around them.
 */
const skin = (builder, first, last, lengthwise, label, materialInside = true) => {
  const names = ["right", "top", "left", "bottom"];
  for (const q of quarters) {
    const loop = [first[q], lengthwise[next(q)], -last[q], -lengthwise[q]];
    builder.patch("coons", `${label} ${names[q]}`, materialInside ? loop : turned(loop));
  }
};

function intake() {
  const builder = new Builder();
  const length = 3;
  const rise = 0.7;
  const straightFrom = 2.1;
  const half = 0.55;
  const outletRadius = 0.5;
  const smooth = (t) => t * t * (3 - 2 * t);
  const axisHeight = (x) => rise * smooth(Math.min(1, x / straightFrom));
  const diagonals = [[1, -1], [1, 1], [-1, 1], [-1, -1]]; // prettier-ignore

  const inlet = square(builder, diagonals.map(([y, z]) => [0, y * half, z * half]), "inlet"); // prettier-ignore
  const outlet = circle(builder, [length, 0, rise], outletRadius, yAxis, zAxis, "outlet");
  const edges = diagonals.map(([y, z], q) => {
    const stations = [0, 0.15, 0.35, 0.55, 0.75, 0.9, 1];
    const places = stations.map((t) => {
      const spread = half + (outletRadius * Math.SQRT1_2 - half) * smooth(t);
      return [length * t, y * spread, axisHeight(length * t) + z * spread];
    });
    return builder.line("spline", places, `duct edge ${q + 1}`);
  });

  const noseAt = 1.95;
  const noseRadius = 0.06;
  const bodyRadius = 0.22;
  const nose = circle(builder, [noseAt, 0, rise], noseRadius, yAxis, zAxis, "nose");
  const hub = circle(builder, [length, 0, rise], bodyRadius, yAxis, zAxis, "hub");
  const ribs = diagonals.map(([y, z], q) => {
    const places = [0, 0.2, 0.45, 0.7, 1].map((t) => {
      const radius = noseRadius + (bodyRadius - noseRadius) * Math.sin((t * Math.PI) / 2);
      return [noseAt + (length - noseAt) * t, y * radius * Math.SQRT1_2, rise + z * radius * Math.SQRT1_2];
    });
    return builder.line("spline", places, `centrebody rib ${q + 1}`);
  });

  builder.patch("planar", "inlet", turned(inlet));
  skin(builder, inlet, outlet, edges, "duct");
  builder.patch("planar", "nose", nose);
  skin(builder, nose, hub, ribs, "centrebody", false);
  builder.patch("planar", "outlet", outlet, hub);
  builder.backgroundRow(
    [
      { x: -0.2, size: 0.2 },
      { x: 1.1, size: 0.15 },
      { x: 1.95, size: 0.075 },
      { x: 3.2, size: 0.12 },
    ],
    [-0.9, 0.9],
    [-0.8, 1.5],
  );
  builder.write(
    "engine-intake.json",
    "Engine intake",
    "An S-shaped intake from a square inlet to a circular outlet, with a centrebody that starts inside it.",
  );
}

function unitCube() {
  const builder = new Builder();
  const corner = (code) => [code & 1, (code >> 1) & 1, code >> 2];
  const faces = { left: [0, 4, 6, 2], right: [1, 3, 7, 5], front: [0, 1, 5, 4], back: [2, 6, 7, 3], bottom: [0, 2, 3, 1], top: [4, 5, 7, 6] }; // prettier-ignore
  for (const [name, codes] of Object.entries(faces)) {
    const sides = codes.map((code, i) =>
      builder.line("straight", [corner(code), corner(codes[(i + 1) % 4])]),
    );
    builder.patch("planar", name, sides);
  }
  builder.nodes.push(
    { id: 1, at: [-0.5, -0.5, -0.5], size: 0.16 },
    { id: 2, at: [5, -0.5, -0.5], size: 0.16 },
    { id: 3, at: [-0.5, 5, -0.5], size: 0.16 },
    { id: 4, at: [-0.5, -0.5, 5], size: 0.16 },
  );
  builder.tetrahedra.push([1, 2, 3, 4]);
  builder.write(
    "unit-cube.json",
    "Unit cube",
    "Six planar patches and a background grid of one tetrahedron.",
  );
}

function duct() {
  const builder = new Builder();
  const height = 2;
  const corners = [[0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0], [-0.5, -0.5, 0]]; // prettier-ignore
  const bottom = square(builder, corners, "square");
  const top = circle(builder, [0, 0, height], 0.5, xAxis, yAxis, "circle");
  const edges = corners.map(([x, y], q) => {
    const waist = Math.SQRT1_2 * 0.75;
    const end = Math.SQRT1_2;
    return builder.line(
      "parabolic",
      [[x, y, 0], [x * waist * 1.2, y * waist * 1.2, height / 2], [x * end, y * end, height]], // prettier-ignore
      `edge ${q + 1}`,
    );
  });
  builder.patch("planar", "square end", turned(bottom));
  skin(builder, bottom, top, edges, "wall");
  builder.patch("planar", "round end", top);
  builder.nodes.push(
    { id: 1, at: [0, 0, 12], size: 0.2 },
    { id: 2, at: [-6, -4, -1], size: 0.11 },
    { id: 3, at: [6, -4, -1], size: 0.11 },
    { id: 4, at: [0, 8, -1], size: 0.11 },
  );
  builder.tetrahedra.push([1, 2, 3, 4]);
  builder.write(
    "square-to-circle.json",
    "Square to circle",
    "A waisted duct: four Coons patches between a square and a circle.",
  );
}

function plate() {
  const builder = new Builder();
  const halfLength = 1;
  const halfWidth = 0.6;
  const thickness = 0.25;
  const radius = 0.3;
  const rectangle = (z) => [[halfLength, -halfWidth, z], [halfLength, halfWidth, z], [-halfLength, halfWidth, z], [-halfLength, -halfWidth, z]]; // prettier-ignore
  const low = rectangle(0);
  const high = rectangle(thickness);
  const bottom = square(builder, low, "bottom");
  const top = square(builder, high, "top");
  const posts = low.map((at, q) => builder.line("straight", [at, high[q]], `corner ${q + 1}`));
  const lowRim = circle(builder, [0, 0, 0], radius, xAxis, yAxis, "lower rim");
  const highRim = circle(builder, [0, 0, thickness], radius, xAxis, yAxis, "upper rim");
  const bores = quarters.map((q) => {
    const [at] = arc([0, 0, 0], radius, xAxis, yAxis, 90 * q - 45, 90 * q + 45, 5);
    return builder.line("straight", [at, [at[0], at[1], thickness]], `bore ${q + 1}`);
  });
  builder.patch("planar", "bottom", turned(bottom), turned(lowRim));
  builder.patch("planar", "top", top, highRim);
  const names = ["right", "back", "left", "front"];
  for (const q of quarters) {
    builder.patch("planar", `${names[q]} side`, [bottom[q], posts[next(q)], -top[q], -posts[q]]);
  }
  skin(builder, lowRim, highRim, bores, "bore", false);
  builder.backgroundRow(
    [
      { x: -1.1, size: 0.14 },
      { x: 0, size: 0.07 },
      { x: 1.1, size: 0.14 },
    ],
    [-0.7, 0.7],
    [-0.1, 0.35],
  );
  builder.write(
    "plate-with-hole.json",
    "Plate with a hole",
    "Planar patches with a round hole, its wall of Coons patches, finer around the bore.",
  );
}

intake();
unitCube();
duct();
plate();

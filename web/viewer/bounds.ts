import type { Project } from "tetrafront/project";
import type { Entity } from "../document/entities";
import { findRecord, indexById } from "../document/entities";
import type { Position } from "../document/position";
import type { SampledProject } from "./scene-state";
import { bodyCorners, shownBox, type ShownBody } from "./shown-bodies";

/** An axis-aligned box around positions. */
export class Bounds {
  readonly low: [number, number, number] = [Infinity, Infinity, Infinity];
  readonly high: [number, number, number] = [-Infinity, -Infinity, -Infinity];

  /** Grows to contain a position. */
  add(x: number, y: number, z: number): this {
    this.low[0] = Math.min(this.low[0], x);
    this.low[1] = Math.min(this.low[1], y);
    this.low[2] = Math.min(this.low[2], z);
    this.high[0] = Math.max(this.high[0], x);
    this.high[1] = Math.max(this.high[1], y);
    this.high[2] = Math.max(this.high[2], z);
    return this;
  }

  /** Grows to contain the points `from` to before `to` of a flat array. */
  addAll(points: ArrayLike<number>, from = 0, to = points.length / 3): this {
    for (let i = 3 * from; i < 3 * to; i += 3)
      this.add(points[i] ?? 0, points[i + 1] ?? 0, points[i + 2] ?? 0);
    return this;
  }

  get empty(): boolean {
    return this.low[0] > this.high[0];
  }

  /** The origin if empty. */
  get centre(): Position {
    if (this.empty) return [0, 0, 0];
    const [low, high] = [this.low, this.high];
    return [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
  }

  /** Half the diagonal; 1 if empty. */
  get radius(): number {
    if (this.empty) return 1;
    const [low, high] = [this.low, this.high];
    return Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;
  }
}

/** Largest difference of two boxes that may enclose the same body, as a share of their radius. */
const alike = 0.2;

/** Returns whether two boxes may enclose the same body: that of its points differs from that of its mesh a little. */
export function areAlike(a: Bounds, b: Bounds): boolean {
  if (a.empty || b.empty) return a.empty === b.empty;
  const apart = (p: Position, q: Position): number => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  return Math.max(apart(a.low, b.low), apart(a.high, b.high)) <= alike * Math.max(a.radius, b.radius);
}

/** Returns the bounds of the model's points and bodies; without any, those of the background grid. */
export function projectBounds(project: Project, bodies: readonly ShownBody[] = []): Bounds {
  const bounds = new Bounds();
  for (const body of bodies) addBox(bounds, body);
  const records = project.points.length > 0 || !bounds.empty ? project.points : project.background.nodes;
  for (const { position } of records) bounds.add(...position);
  return bounds;
}

function addBox(bounds: Bounds, body: ShownBody): void {
  const box = shownBox(body);
  if (box) bounds.add(...box.low).add(...box.high);
}

/** Returns the bounds of a project; without extent, a cube of edge length 2, as room to draw in. */
export function roomyBounds(project: Project, bodies: readonly ShownBody[] = []): Bounds {
  const bounds = projectBounds(project, bodies);
  if (bounds.empty) bounds.add(0, 0, 0);
  if (bounds.radius > 0) return bounds;
  const [x, y, z] = bounds.centre;
  return bounds.add(x - 1, y - 1, z - 1).add(x + 1, y + 1, z + 1);
}

/** What `shownBounds` reads of the state. */
interface Shown {
  readonly project: Project;
  readonly preview: SampledProject | null;
  readonly bodies: readonly ShownBody[];
  readonly layers: { readonly background: boolean };
}

/** Returns whether lines and patches have been sampled since they changed. */
export function isSampled<S extends Pick<Shown, "project" | "preview">>(
  shown: S,
): shown is S & { readonly preview: SampledProject } {
  const { project, preview } = shown;
  return (
    preview?.project.points === project.points &&
    preview.project.lines === project.lines &&
    preview.project.patches === project.patches
  );
}

/**
 * Returns the bounds of a project with its sampled lines and patches, which may leave the box of their points, and with the
 * background grid if it is shown. Samples of an earlier state of the project are not used.
 */
export function shownBounds(shown: Shown): Bounds {
  const { project, bodies, layers } = shown;
  const bounds = roomyBounds(project, bodies);
  if (isSampled(shown)) {
    const { linePoints, patchPoints } = shown.preview.samples;
    bounds.addAll(linePoints).addAll(patchPoints);
  }
  if (layers.background) for (const { position } of project.background.nodes) bounds.add(...position);
  return bounds;
}

/** Returns the bounds of an entity; empty if it does not exist or has not been sampled. */
export function entityBounds(
  entity: Entity,
  project: Project,
  preview: SampledProject | null,
  bodies: readonly ShownBody[] = [],
): Bounds {
  const bounds = new Bounds();
  switch (entity.kind) {
    case "point":
    case "background-node": {
      const record = findRecord(project, entity.kind, entity.id);
      if (record) bounds.add(...record.position);
      break;
    }
    case "source": {
      for (const position of findRecord(project, "source", entity.id)?.positions ?? [])
        bounds.add(...position);
      break;
    }
    case "body": {
      const body = bodies.find(({ id }) => id === entity.id);
      if (body) addBox(bounds, body);
      break;
    }
    case "body-patch":
      for (const body of bodies) addBodyPatch(entity.id, body, bounds);
      break;
    case "line":
    case "patch":
      if (preview) addSamples(entity, preview, bounds);
      break;
  }
  return bounds;
}

function addBodyPatch(id: number, body: ShownBody, bounds: Bounds): void {
  const patch = body.patches.findIndex((other) => other.id === id);
  if (patch < 0 || !body.given) return;
  const { order, patchOffsets } = body.given.drawn;
  const triangles = order.subarray(patchOffsets[patch], patchOffsets[patch + 1]);
  // A sample of a large patch shows where it is.
  const step = Math.max(1, Math.floor(triangles.length / maxSampled));
  bounds.addAll(
    bodyCorners(
      body,
      [...triangles].filter((_, t) => t % step === 0),
    ),
  );
}

/** Number of triangles that stand for a patch of a body. */
const maxSampled = 2000;

function addSamples({ kind, id }: Entity, { samples, project }: SampledProject, bounds: Bounds): void {
  const index = indexById(project, kind).get(id);
  if (index === undefined) return;
  if (kind === "line") {
    const { linePoints, lineOffsets } = samples;
    bounds.addAll(linePoints, lineOffsets[index], lineOffsets[index + 1]);
    return;
  }
  const { patchPoints, patchTriangles, patchOffsets } = samples;
  const end = 3 * (patchOffsets[index + 1] ?? 0);
  for (let corner = 3 * (patchOffsets[index] ?? 0); corner < end; ++corner) {
    const node = patchTriangles[corner] ?? 0;
    bounds.addAll(patchPoints, node, node + 1);
  }
}

/** Returns the bounds of points given as x y z in a row. */
export function boundsOf(points: ArrayLike<number>): Bounds {
  return new Bounds().addAll(points);
}

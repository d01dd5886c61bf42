import type { Project, ProjectPreview } from "tetrafront";
import type { Entity } from "../document/entities";
import { findRecord, positionsById } from "../document/entities";
import type { Position } from "./layers/layer";

/** An axis-aligned box that grows with the places put into it. */
export class Bounds {
  readonly low: [number, number, number] = [Infinity, Infinity, Infinity];
  readonly high: [number, number, number] = [-Infinity, -Infinity, -Infinity];

  add(x: number, y: number, z: number): this {
    this.low[0] = Math.min(this.low[0], x);
    this.low[1] = Math.min(this.low[1], y);
    this.low[2] = Math.min(this.low[2], z);
    this.high[0] = Math.max(this.high[0], x);
    this.high[1] = Math.max(this.high[1], y);
    this.high[2] = Math.max(this.high[2], z);
    return this;
  }

  /** Adds the places of a flat array, from one to before another. */
  addAll(places: Float64Array, from = 0, to = places.length / 3): this {
    for (let i = 3 * from; i < 3 * to; i += 3)
      this.add(places[i] ?? 0, places[i + 1] ?? 0, places[i + 2] ?? 0);
    return this;
  }

  get empty(): boolean {
    return this.low[0] > this.high[0];
  }

  get centre(): Position {
    return this.empty
      ? [0, 0, 0]
      : ([0, 1, 2].map((k) => mean(this.low[k], this.high[k])) as unknown as Position);
  }

  /** Half the diagonal. */
  get radius(): number {
    if (this.empty) return 1;
    const [x = 0, y = 0, z = 0] = [0, 1, 2].map((k) => (this.high[k] ?? 0) - (this.low[k] ?? 0));
    return Math.hypot(x, y, z) / 2;
  }
}

const mean = (a = 0, b = 0): number => (a + b) / 2;

/** Around what is modelled; the background grid counts only where there is nothing else. */
export function projectBounds(project: Project): Bounds {
  const places = project.points.length > 0 ? project.points : project.background.nodes;
  const bounds = new Bounds();
  for (const { at } of places) bounds.add(...at);
  return bounds;
}

/** As `projectBounds`, with room to draw in where there is no extent yet. */
export function roomyBounds(project: Project): Bounds {
  const bounds = projectBounds(project);
  if (bounds.empty) bounds.add(0, 0, 0);
  if (bounds.radius > 0) return bounds;
  const [x, y, z] = bounds.centre;
  return bounds.add(x - 1, y - 1, z - 1).add(x + 1, y + 1, z + 1);
}

/** Around one entity, as far as its shape is known. */
export function entityBounds(entity: Entity, project: Project, preview: ProjectPreview | null): Bounds {
  const bounds = new Bounds();
  switch (entity.kind) {
    case "point":
    case "background-node": {
      const record = findRecord(project, entity.kind, entity.id);
      if (record) bounds.add(...record.at);
      break;
    }
    case "source": {
      for (const place of findRecord(project, "source", entity.id)?.places ?? []) bounds.add(...place);
      break;
    }
    case "line": {
      const position = positionsById(project, "line").get(entity.id);
      if (preview && position !== undefined) {
        const { linePoints, lineOffsets } = preview;
        bounds.addAll(linePoints, lineOffsets[position], lineOffsets[position + 1]);
      }
      break;
    }
    case "patch": {
      const position = positionsById(project, "patch").get(entity.id);
      if (!preview || position === undefined) break;
      const { patchPoints, patchTriangles, patchOffsets } = preview;
      const last = 3 * (patchOffsets[position + 1] ?? 0);
      for (let i = 3 * (patchOffsets[position] ?? 0); i < last; ++i) {
        const node = patchTriangles[i] ?? 0;
        bounds.addAll(patchPoints, node, node + 1);
      }
      break;
    }
  }
  return bounds;
}

/** Of places given as x y z in a row. */
export function boundsOf(places: readonly number[]): Bounds {
  const bounds = new Bounds();
  for (let i = 0; i + 2 < places.length; i += 3) {
    bounds.add(places[i] ?? 0, places[i + 1] ?? 0, places[i + 2] ?? 0);
  }
  return bounds;
}

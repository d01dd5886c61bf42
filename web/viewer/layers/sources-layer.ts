import type { Project, ProjectSource } from "tetrafront";
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments } from "three";
import type { ViewerColors } from "../colors";
import { DotsLayer, type DotState } from "./dots-layer";
import type { Position, SceneLayer } from "./layer";

/** Straight pieces of a circle. */
const circlePieces = 32;
/** Above this many sources only the marked ones show how far they reach. */
const manySources = 200;

type Vector = [number, number, number];

/** Sources of size: their places, what joins them, and how far their size holds. */
export class SourcesLayer implements SceneLayer {
  readonly root = new Group();
  readonly #material = new LineBasicMaterial({ transparent: true, depthTest: false });
  readonly #reachMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.55, depthWrite: false });
  readonly #markedMaterial = new LineBasicMaterial({ transparent: true, depthTest: false });
  readonly #joins = new LineSegments(new BufferGeometry(), this.#material);
  readonly #reaches = new LineSegments(new BufferGeometry(), this.#reachMaterial);
  readonly #marked = new LineSegments(new BufferGeometry(), this.#markedMaterial);
  readonly places = new DotsLayer("square", (colors) => colors.source);
  #sources: readonly ProjectSource[] = [];
  #origin: Position = [0, 0, 0];

  constructor() {
    for (const lines of [this.#joins, this.#reaches, this.#marked]) {
      lines.frustumCulled = false;
      lines.renderOrder = 6;
      this.root.add(lines);
    }
    this.root.add(this.places.root);
  }

  setColors(colors: ViewerColors): void {
    this.#material.color.set(colors.source);
    this.#reachMaterial.color.set(colors.source);
    this.#markedMaterial.color.set(colors.selection);
    this.places.setColors(colors);
  }

  setSources(project: Project, origin: Position): void {
    this.#sources = project.background.sources ?? [];
    this.#origin = origin;
    this.places.setPlaces(
      this.#sources.flatMap(({ places }) => places),
      origin,
    );
  }

  /** One state per source, in the project's order. */
  setStates(states: readonly DotState[]): void {
    this.places.setStates(this.#sources.flatMap(({ places }, s) => places.map(() => states[s] ?? "hidden")));
    const joins: number[] = [];
    const reaches: number[] = [];
    const marked: number[] = [];
    const few = this.#sources.length <= manySources;
    this.#sources.forEach((source, s) => {
      const state = states[s] ?? "hidden";
      if (state === "hidden") return;
      const isMarked = state !== "normal";
      this.#join(source, isMarked ? marked : joins);
      if (isMarked || few) this.#reach(source, isMarked ? marked : reaches);
    });
    replace(this.#joins, joins);
    replace(this.#reaches, reaches);
    replace(this.#marked, marked);
  }

  dispose(): void {
    for (const lines of [this.#joins, this.#reaches, this.#marked]) {
      lines.geometry.dispose();
      lines.material.dispose();
    }
    this.places.dispose();
  }

  #local(place: Position): Vector {
    return [place[0] - this.#origin[0], place[1] - this.#origin[1], place[2] - this.#origin[2]];
  }

  /** The segment, or the sides of the triangle. */
  #join({ places }: ProjectSource, ends: number[]): void {
    places.forEach((place, i) => {
      const next = places[(i + 1) % places.length] ?? place;
      if (places.length === 2 && i === 1) return;
      ends.push(...this.#local(place), ...this.#local(next));
    });
  }

  /** Circles around every place, and what joins them: the outline of all that is within the distance. */
  #reach({ places, distance = 0 }: ProjectSource, ends: number[]): void {
    if (!(distance > 0)) return;
    for (const place of places) {
      for (let axis = 0; axis < 3; ++axis) circle(this.#local(place), axis, distance, ends);
    }
    places.forEach((place, i) => {
      const next = places[(i + 1) % places.length] ?? place;
      if (places.length === 1 || (places.length === 2 && i === 1)) return;
      const from = this.#local(place);
      const to = this.#local(next);
      for (const aside of acrossOf(from, to, distance)) {
        ends.push(...add(from, aside), ...add(to, aside));
      }
    });
  }
}

const add = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

/** Four directions across a segment, of a length. */
function acrossOf(from: Vector, to: Vector, length: number): Vector[] {
  const along = add(to, [-from[0], -from[1], -from[2]]);
  const [x, y, z] = along;
  const first: Vector = Math.abs(z) > Math.max(Math.abs(x), Math.abs(y)) ? [0, -z, y] : [-y, x, 0];
  const second: Vector = [
    y * first[2] - z * first[1],
    z * first[0] - x * first[2],
    x * first[1] - y * first[0],
  ];
  return [first, second].flatMap((across) => {
    const scale = length / (Math.hypot(...across) || 1);
    const unit: Vector = [across[0] * scale, across[1] * scale, across[2] * scale];
    return [unit, [-unit[0], -unit[1], -unit[2]] as Vector];
  });
}

/** A circle across one axis. */
function circle(centre: Vector, axis: number, radius: number, ends: number[]): void {
  const place = (piece: number): Vector => {
    const angle = (2 * Math.PI * piece) / circlePieces;
    const at: Vector = [...centre];
    at[(axis + 1) % 3] = (at[(axis + 1) % 3] ?? 0) + radius * Math.cos(angle);
    at[(axis + 2) % 3] = (at[(axis + 2) % 3] ?? 0) + radius * Math.sin(angle);
    return at;
  };
  for (let piece = 0; piece < circlePieces; ++piece) ends.push(...place(piece), ...place(piece + 1));
}

function replace(lines: LineSegments, ends: readonly number[]): void {
  lines.visible = ends.length > 0;
  lines.geometry.dispose();
  lines.geometry = new BufferGeometry().setAttribute(
    "position",
    new BufferAttribute(Float32Array.from(ends), 3),
  );
}

import type { AdvanceStep, Trace } from "tetrafront";
import { Group } from "three";
import type { Position } from "../document/position";
import { add, cross, scale, subtract, unit } from "../document/vectors";
import type { Layer } from "../viewer/layers/layer";
import type { SceneChanges } from "../viewer/scene-state";
import { faceSize } from "./front-values";
import { cornersOf } from "./judge";
import type { LensCandidate } from "./lens";
import { Dots, Facets, Segments } from "./lens-parts";
import { outlineOf, type SearchRegion } from "./search-region";

/** Length of the drawn normal, in sizes of the base face. */
const normalLength = 0.5;

/** What the lens shows: an advance with the examined candidate; null to show nothing. */
export interface LensScene {
  readonly trace: Trace;
  readonly step: AdvanceStep;
  readonly examined: LensCandidate | null;
  readonly region: SearchRegion | null;
  readonly showsIdeal: boolean;
}

/**
 * The base face with its normal, ideal point and search region, the element of a candidate, and what it crosses. Shows
 * through everything.
 */
export class LensLayer implements Layer {
  readonly root = new Group();
  readonly #base = new Facets("selection", 0.6);
  readonly #culprit = new Facets("front", 0.75);
  readonly #normal = new Segments("selection");
  readonly #element = new Segments("hover");
  readonly #region = new Segments("source");
  readonly #ideal = new Dots("source", 9);
  readonly #candidate = new Dots("hover", 9);
  readonly #crossing = new Dots("front", 11);
  readonly #parts = [
    this.#base,
    this.#culprit,
    this.#normal,
    this.#element,
    this.#region,
    this.#ideal,
    this.#candidate,
    this.#crossing,
  ];
  #scene: LensScene | null = null;
  #origin: Position = [0, 0, 0];

  constructor() {
    this.#parts.forEach(({ object }, order) => {
      object.frustumCulled = false;
      object.renderOrder = 20 + order;
      this.root.add(object);
    });
  }

  update(changes: SceneChanges): void {
    const { colors, origin } = changes.state;
    if (changes.has("colors")) for (const part of this.#parts) part.setColors(colors);
    if (!changes.has("origin")) return;
    this.#origin = origin;
    this.show(this.#scene);
  }

  show(scene: LensScene | null): void {
    this.#scene = scene;
    this.root.visible = scene !== null;
    if (!scene) return;
    const { trace, step, examined, region, showsIdeal } = scene;
    const base = cornersOf(trace, step.face);
    const centroid = scale(add(add(base[0], base[1]), base[2]), 1 / 3);
    const normal = unit(cross(subtract(base[1], base[0]), subtract(base[2], base[0]))) ?? [0, 0, 1];
    const tip = add(centroid, scale(normal, normalLength * faceSize(trace, step.face)));
    const apex = examined?.candidate.position;
    const culprit = examined?.candidate.culprit ?? examined?.crossed[0];
    const pair = examined?.pair;
    this.#base.set(base, this.#origin);
    this.#culprit.set(culprit === undefined ? [] : cornersOf(trace, culprit), this.#origin);
    this.#normal.set([centroid, tip, ...(pair ? pair.side : [])], this.#origin);
    this.#element.set(apex ? base.flatMap((corner) => [corner, apex]) : [], this.#origin);
    this.#region.set(region ? outlineOf(region) : [], this.#origin);
    this.#ideal.set(showsIdeal ? [step.idealPoint] : [], this.#origin);
    this.#candidate.set(apex ? [apex] : [], this.#origin);
    this.#crossing.set(pair ? [pair.point] : [], this.#origin);
  }

  dispose(): void {
    for (const part of this.#parts) part.dispose();
  }
}

import type { LineType } from "tetrafront/project";
import { circleThrough, middleOfArc, onArc, quantityMiddleOfArc } from "../../document/arcs";
import { drawLine, placeAt, quantitiesAt, samePlace, type Place } from "../../document/draw";
import { findRecord } from "../../document/entities";
import { runsThroughMany } from "../../document/line-types";
import { turned } from "../../document/circles";
import { planeOfPatch } from "../../document/patch-planes";
import type { Position } from "../../document/position";
import {
  addQuantities,
  scaleQuantities,
  storableTexts,
  turnedQuantities,
  valuesOf,
  type QuantityPosition,
} from "../../document/quantity-positions";
import { addScaled, dot, length, subtract, unit, type Frame } from "../../document/vectors";
import { onPlane, planeAlong } from "../../document/work-plane";
import { valueOf, type Quantity } from "../../expressions/quantity";
import { sampledCurve } from "../../viewer/curves";
import { emptySketch, type Sketch } from "../../viewer/layers/drawing-layer";
import type { Layer } from "../../viewer/layers/layer";
import type { HistoryEntry } from "../../session/history";
import { operationStrings, strings } from "../../strings";
import type { DrawingState } from "./drawing";
import type { ToolPointer } from "../interaction";
import { DrawingTool } from "./drawing-tool";
import type { Snap } from "./snapping";

/** Numbers of places of each type of line: with `max`, the line is complete. */
const counts: { readonly [T in LineType]: { readonly min: number; readonly max: number } } = {
  straight: { min: 2, max: 2 },
  parabolic: { min: 3, max: 3 },
  spline: { min: 3, max: Infinity },
  hermite: { min: 2, max: Infinity },
  arc: { min: 3, max: 3 },
  // The centre, and a place on the circle.
  circle: { min: 2, max: 2 },
};

/** Number of places of a circle through three of them. */
const placesOfCircle = 3;

/** Segments with which a circle is drawn before it exists. */
const circleSamples = 64;

const isRound = (type: LineType): boolean => type === "circle" || type === "arc";

/** Sine of the angle at which a line still lies in a plane. */
const planarity = 1e-9;

/** A straight line of the present chain. */
interface Link {
  readonly line: number;
  /** Id of the first point of the line, which a split keeps. */
  readonly first: number | undefined;
  /** Its first place as it was picked: a point that the line has created is gone without the line. */
  readonly picked: Place;
  /** Ids of its points. */
  readonly from: number;
  readonly to: number;
  readonly closes: boolean;
  /** The change of the step that added it; null if the project had the line already. */
  readonly step: HistoryEntry["change"] | null;
}

/**
 * Draws lines through places. Straight lines form a chain: each click adds one from the place before. Other lines are
 * added when they have all their places; splines when Enter, a double click or the first place ends them.
 */
export class LineTool extends DrawingTool {
  /** Places of the line that is being drawn. */
  #places: readonly Place[] = [];
  /** The lines of the chain, with those at its end that undo has taken back: redo may bring them again. */
  #links: readonly Link[] = [];
  /** Number of links that the project had when it was last looked at. */
  #drawn = 0;

  /** Whether the expressions of the line are too long to be kept. */
  #areNumbersKept = false;

  #stopListening: readonly (() => void)[] = [];

  override overlay(): Layer {
    const { documents, view } = this.stores;
    this.#stopListening = [
      view.state.subscribe((state, before) => {
        if (state.lineType !== before.lineType || state.circleBy !== before.circleBy) this.#drop();
      }),
      // The ids of another document mean other lines.
      documents.state.subscribe(({ id }, before) => {
        if (id !== before.id) this.#drop();
      }),
    ];
    return super.overlay();
  }

  /** A circle or an arc that begins on a planar patch stays in the plane of the patch. */
  protected override get frame(): Frame {
    const patch = isRound(this.#type) ? this.#places[0]?.patch : undefined;
    return (patch === undefined ? null : this.#planeOf(patch)) ?? super.frame;
  }

  protected override snapAt(pointer: ToolPointer): Snap | null {
    const snap = super.snapAt(pointer);
    const patch = isRound(this.#type) ? this.#places[0]?.patch : undefined;
    if (patch === undefined || snap?.kind !== "patch" || snap.id === patch) return snap;
    const position = onPlane(this.stores.viewer.seenFrom(pointer.at).ray, this.frame);
    return position ? { kind: "plane", id: null, position } : snap;
  }

  get picked(): number {
    this.#follow();
    return this.#places.length;
  }

  protected pick(place: Place): void {
    this.#follow();
    // Undo may open a closed chain again, until the next place begins another one.
    if (this.#links[this.#drawn - 1]?.closes === true) this.#drop();
    const before = this.#places.at(-1);
    if (before && samePlace(before, place)) return;
    const [first] = this.#places;
    const closes =
      runsThroughMany(this.#type) && first && this.#places.length >= 3 && samePlace(first, place);
    this.#places = [...this.#places, place];
    if (this.#isStraightCircle()) {
      this.#places = this.#places.slice(0, -1);
      this.stores.drawing.state.setState({ refused: strings.drawing.noCircle });
    } else if (closes || this.#places.length >= this.#placeCount) this.#add();
  }

  protected last(): QuantityPosition | null {
    const last = this.#places.at(-1);
    return last ? quantitiesAt(this.project, last) : null;
  }

  /** A number is the radius of the circle around the picked centre, or of the arc between the two picked places. */
  protected override takeNumber(radius: Quantity): DrawingState["mistake"] | undefined {
    const [first, second] = this.picked > 0 ? this.#places : [];
    const isCircle = this.#type === "circle" && !this.#isThroughThree && this.picked === 1;
    const isArc = this.#type === "arc" && this.picked === 2;
    if (!first || (!isCircle && !isArc)) return undefined;
    if (valueOf(radius) <= 0) return "no-radius";
    const centre = quantitiesAt(this.project, first);
    if (isCircle) {
      const [on] = this.#together([], [addQuantities(centre, scaleQuantities(this.frame.x, radius))]);
      if (on) this.pick(on);
      return null;
    }
    if (!second) return undefined;
    const ends = [centre, quantitiesAt(this.project, second)] as const;
    const middle = quantityMiddleOfArc(ends, radius, this.frame.z, this.seen);
    if (!middle) return "short-radius";
    const [from, to, through] = this.#together([first, second], [middle]);
    if (!from || !to || !through) return undefined;
    this.#places = [from, through, to];
    this.#add();
    return null;
  }

  /** Of a circle, the place that a typed radius picks; of an arc, its middle. */
  protected override placeOfNumber(radius: number): Position | null {
    const [first, second] = this.picked > 0 ? this.#places : [];
    if (!first || radius <= 0 || this.#isThroughThree) return null;
    if (this.#type === "circle") return addScaled(first.position, this.frame.x, radius);
    if (this.#type !== "arc" || !second) return null;
    return middleOfArc([first.position, second.position], radius, this.frame.z, this.seen);
  }

  protected finish(): void {
    if (runsThroughMany(this.#type) && this.#places.length >= counts[this.#type].min) this.#add();
    this.#drop();
  }

  protected removeLast(): boolean {
    this.#follow();
    const link = this.#links[this.#drawn - 1];
    if (link) {
      const { past } = this.stores.documents.state.getState().history;
      if (link.step !== null && past.at(-1)?.change === link.step) this.stores.documents.undo();
      else this.#links = this.#links.slice(0, this.#drawn - 1);
      this.#follow();
      return true;
    }
    const hadPlaces = this.#places.length > 0;
    this.#places = this.#places.slice(0, -1);
    return hadPlaces;
  }

  /** Places of a line that does not exist yet are no steps of undo. */
  override get canTakeBack(): boolean {
    return this.picked > 0 && this.#drawn === 0;
  }

  protected leave(): boolean {
    const hadPlaces = this.#places.length > 0;
    this.#drop();
    return hadPlaces;
  }

  protected sketch(): Sketch {
    const places = this.#places.map(({ position }) => position);
    const next = this.snap?.position;
    const [first, second] = places;
    const isRadiusOfArc = this.#type === "arc" && this.snap?.kind === "radius";
    const ofRadius = isRadiusOfArc && first && next && second && [first, next, second];
    const through = ofRadius || (next ? [...places, next] : places);
    const path = this.#type === "circle" ? this.#circle(through) : sampledCurve(this.#type, through);
    const dots = [...this.#places, ...(this.snap ? [this.placeOf(this.snap)] : [])];
    return {
      ...emptySketch,
      paths: path.length > 1 ? [path] : [],
      dots: dots.filter(({ point }) => point === null).map(({ position }) => position),
    };
  }

  protected override end(): void {
    for (const stop of this.#stopListening) stop();
    this.#drop();
    super.end();
  }

  /** Number of places with which a line is complete. */
  get #placeCount(): number {
    return this.#isThroughThree ? placesOfCircle : counts[this.#type].max;
  }

  get #isThroughThree(): boolean {
    const { lineType, circleBy } = this.stores.view.state.getState();
    return lineType === "circle" && circleBy === "points";
  }

  /** Returns whether three places for a circle lie on one straight line. */
  #isStraightCircle(): boolean {
    const [a, b, c] = this.#places;
    return this.#isThroughThree && !!a && !!b && !!c && !circleThrough(a.position, b.position, c.position);
  }

  get #type(): LineType {
    return this.stores.view.state.getState().lineType;
  }

  #add(): void {
    const type = this.#type;
    const [first] = this.#places;
    const places = type === "circle" ? this.#placesOnCircle() : this.#places;
    const { creation, line, points } = drawLine(this.project, type, places);
    if (creation)
      this.create({ ...creation, ...(this.#areNumbersKept && { note: operationStrings.numbersKept }) });
    else this.stores.view.select({ kind: "line", id: line });
    const [from, to] = points;
    if (type !== "straight" || !first || from === undefined || to === undefined) return this.#drop();
    const links = this.#links.slice(0, this.#drawn);
    const closes = to === links[0]?.from;
    const { past } = this.stores.documents.state.getState().history;
    const step = creation ? (past.at(-1)?.change ?? null) : null;
    const begin = findRecord(this.project, "line", line)?.points[0];
    this.#links = [...links, { line, first: begin, picked: first, from, to, closes, step }];
    this.#follow();
  }

  /**
   * Returns three places on the circle, and the first again: the picked ones, or else those on the circle around the first
   * picked place through the second one.
   */
  #placesOnCircle(): readonly Place[] {
    const [centre, on] = this.#places;
    if (!centre || !on) return [];
    if (this.#isThroughThree) return [...this.#places, centre];
    const [middle, from] = [quantitiesAt(this.project, centre), quantitiesAt(this.project, on)];
    const normal = this.#normalOfCircle(centre.position, on.position, on.patch);
    const third = (turns: number) => turnedQuantities(from, middle, normal, turns / 3);
    const [start, ...others] = this.#together([on], [third(1), third(2)]);
    return start ? [start, ...others, start] : [];
  }

  /**
   * Returns picked and computed places of a line. Computed ones have the expressions of their coordinates; if one of these
   * is too long, no place has any.
   */
  #together(picked: readonly Place[], computed: readonly QuantityPosition[]): readonly Place[] {
    const texts = storableTexts(computed);
    this.#areNumbersKept = !texts;
    const plain = ({ expressions: _, ...place }: Place): Place => place;
    const places = computed.map((position, i) => placeAt(this.project, valuesOf(position), texts?.[i]));
    return [...(texts ? picked : picked.map(plain)), ...places];
  }

  /**
   * Returns the normal of the plane of a circle around a centre through a place: that of the patch on which the place lies,
   * if the plane contains both; otherwise that of the plane through both which is nearest to the work plane.
   */
  #normalOfCircle(centre: Position, on: Position, patch: number | undefined): Position {
    const arm = unit(subtract(on, centre));
    const ofPatch = patch === undefined ? null : this.#planeOf(patch);
    const frames = [...(ofPatch ? [ofPatch] : []), this.frame];
    if (!arm) return this.frame.z;
    const flat = frames.find(({ z }) => Math.abs(dot(z, arm)) <= planarity);
    const { z, x } = this.frame;
    const nearest = (axis: Position): Position | null => {
      const across = addScaled(axis, arm, -dot(axis, arm));
      return length(across) > planarity ? unit(across) : null;
    };
    return flat?.z ?? nearest(z) ?? nearest(x) ?? z;
  }

  /** Returns the plane of a planar patch; null for any other patch. */
  #planeOf(patch: number): Frame | null {
    const plane = planeOfPatch(this.project, patch);
    return plane ? planeAlong(plane.normal, plane.corner).frame : null;
  }

  /** Returns positions along the circle around the first of two positions, or through three. */
  #circle(through: readonly Position[]): readonly Position[] {
    const [centre, on, third] = through;
    if (!centre || !on) return [];
    if (this.#isThroughThree) {
      const circle = third && circleThrough(centre, on, third);
      if (!circle) return through;
      return Array.from({ length: circleSamples + 1 }, (_, i) => onArc(circle, i / circleSamples));
    }
    const patch = this.snap?.kind === "patch" ? this.snap.id : null;
    const normal = this.#normalOfCircle(centre, on, patch ?? undefined);
    return Array.from({ length: circleSamples + 1 }, (_, i) => turned(on, centre, normal, i / circleSamples));
  }

  #placeOfPoint(id: number): Place | undefined {
    const point = findRecord(this.project, "point", id);
    return point && { point: id, position: point.position };
  }

  /** Undo and redo move the end of the chain. An edit in a panel may have removed points. */
  #follow(): void {
    const drawn = this.#links.findLastIndex((link, index) => this.#exists(link, index)) + 1;
    if (drawn !== this.#drawn) {
      this.#drawn = drawn;
      this.#places = this.#endOfChain();
    } else if (!this.#places.every(({ point }) => point === null || this.#placeOfPoint(point))) this.#drop();
  }

  /**
   * Returns whether the project has the line of a link. Its id does not suffice: once the line is gone, another one may get
   * it. Only redo, or undo of a deletion, brings the line back.
   */
  #exists({ line, first, step }: Link, index: number): boolean {
    const found = findRecord(this.project, "line", line);
    if (first === undefined || !found?.points.includes(first)) return false;
    if (index < this.#drawn || step === null) return true;
    const { past } = this.stores.documents.state.getState().history;
    return past.some(({ change }) => change === step);
  }

  /** Returns the place from which the chain goes on; none if it is closed. */
  #endOfChain(): readonly Place[] {
    const [last, next] = [this.#links[this.#drawn - 1], this.#links[this.#drawn]];
    if (last?.closes === true) return [];
    const place = last ? this.#placeOfPoint(last.to) : next && (this.#placeOfPoint(next.from) ?? next.picked);
    return place ? [place] : [];
  }

  #drop(): void {
    this.#areNumbersKept = false;
    this.#places = [];
    this.#links = [];
    this.#drawn = 0;
  }
}

/** Positions and labels of what the lens examines, for the view and for drawings. */
import type { TracedCandidate } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { addScaled, cross, mean, subtract, unit } from "../../document/vectors";
import { playerStrings } from "../strings/player";
import type { Segment, Triangle } from "./crossing";
import { faceSize } from "./front-values";
import { cornersOf, newElement } from "./judge";
import { isBeforeTest } from "./beats";
import type { LensScene } from "./lens-scene";
import { nearestOnFace, partInElement } from "./overlap";

/** Further candidates that are drawn: more would hide the others. */
const maxOthers = 8;
/** Length of the drawn normal and of its arrowhead, in sizes of the base face. */
const normalLength = 0.55;
const headLength = 0.12;

/** What a label names: the failing pair has a colour of its own. */
export type MarkKind = "base" | "ideal" | "candidate" | "failing";

export interface LensLabel {
  readonly kind: MarkKind;
  readonly position: Position;
  readonly text: string;
  /** Whether a small view is without it: it names no part of the step that is examined. */
  readonly isMinor?: true;
}

/** Faces and parts of faces are triangles, three positions each; sides are segments, two positions each. */
export interface LensMarks {
  readonly base: Triangle;
  /** The base face's normal, an arrow from its centroid. */
  readonly normal: readonly Position[];
  readonly ideal: readonly Position[];
  /** The examined candidate, and the other ones of the step. */
  readonly candidate: readonly Position[];
  readonly others: readonly Position[];
  /** The sides and faces of the new element at the candidate. */
  readonly newSides: readonly Position[];
  readonly newFaces: readonly Position[];
  readonly isAccepted: boolean;
  /** Faces that would join the front, if the view shows it as it would be. */
  readonly supposed: readonly Position[];
  /** The face that the element would cross, or that a new node is too close to. */
  readonly culprit: readonly Position[];
  /** The face of the new element that a side of the culprit passes through. */
  readonly pierced: readonly Position[];
  /** The side that passes through the other face; or the distance that is too short. */
  readonly failingSide: readonly Position[];
  /** The part of the culprit in the new element, and its outline. */
  readonly overlap: readonly Position[];
  readonly overlapOutline: readonly Position[];
  /** Where the failing side passes through the face; or a node behind the base face. */
  readonly crossing: readonly Position[];
  readonly labels: readonly LensLabel[];
  /** Of a film: the height of the ideal point over the base face. */
  readonly rise: readonly Position[];
  /** Of a film: the sides to all candidates while they are sought, and those to refused ones while they are tested. */
  readonly fans: readonly Position[];
  readonly refusedFans: readonly Position[];
  /** Of a film: the faces of the element that the step has made. */
  readonly made: readonly Position[];
}

/** Returns what is drawn of a scene; of a film, as far as its beat. */
export function lensMarks(scene: LensScene): LensMarks {
  const whole = wholeMarks(scene);
  const { beat, step } = scene;
  if (beat === null) return whole;
  if (beat === "base" || beat === "ideal") return beginningOf(whole, beat === "ideal");
  const tried = step.candidates.slice(0, maxOthers + 1);
  if (beat === "candidates") {
    const { labels } = whole;
    return {
      ...whole,
      ...noFailingMarks,
      isAccepted: false,
      newSides: [],
      newFaces: [],
      fans: tried.flatMap((candidate) => fanOf(whole.base, candidate)),
      labels: labels.filter(({ kind }) => kind !== "failing"),
    };
  }
  // The element, or that no candidate was accepted.
  if (beat !== "test") return { ...whole, made: whole.isAccepted ? whole.newFaces : [] };
  const refused = tried.filter(({ verdict }) => verdict !== "accepted");
  return {
    ...whole,
    normal: [],
    isAccepted: false,
    newFaces: [],
    refusedFans: refused.flatMap((candidate) => fanOf(whole.base, candidate)),
    labels: whole.labels.filter(({ position }) => position !== whole.normal[1]),
  };
}

/** The base face, and the ideal point over it. */
function beginningOf(whole: LensMarks, hasIdeal: boolean): LensMarks {
  const [ideal] = whole.ideal;
  return {
    ...whole,
    ...noFailingMarks,
    ideal: hasIdeal ? whole.ideal : [],
    rise: hasIdeal && ideal ? [mean(whole.base), ideal] : [],
    candidate: [],
    others: [],
    newSides: [],
    newFaces: [],
    normal: hasIdeal ? [] : whole.normal,
    labels: whole.labels.filter(({ kind }) => kind === "base" || (hasIdeal && kind === "ideal")),
  };
}

const fanOf = (base: Triangle, { position }: TracedCandidate): readonly Position[] =>
  base.flatMap((corner) => [corner, position]);

/** What is highlighted of the candidate under the pointer or the focus. */
export interface PointedMarks {
  readonly sides: readonly Position[];
  readonly apex: readonly Position[];
  /** The face that the candidate was refused for. */
  readonly culprit: readonly Position[];
}

/** Returns the marks of a candidate by its rank; null if the scene does not show it. */
export function pointedMarks(scene: LensScene | null, rank: number | null): PointedMarks | null {
  const candidate = scene && rank !== null ? scene.step.candidates[rank] : undefined;
  if (!scene || !candidate || scene.beat === "base" || scene.beat === "ideal") return null;
  const { trace, step, beat } = scene;
  const { culprit } = candidate;
  return {
    sides: fanOf(cornersOf(trace, step.face), candidate),
    apex: [candidate.position],
    culprit: culprit === null || isBeforeTest(beat) ? [] : cornersOf(trace, culprit),
  };
}

export const drawnPointed: readonly DrawnMark<PointedMarks>[] = [
  { form: "faces", of: ({ culprit }) => culprit, color: "failing", opacity: 0.45 },
  { form: "segments", of: ({ sides }) => sides, color: "hover", width: 3 },
  { form: "dots", of: ({ apex }) => apex, color: "hover", size: 16 },
];

/** Returns all marks of a scene. */
function wholeMarks(scene: LensScene): LensMarks {
  const { trace, step, examined, others: all, supposed } = scene;
  const others = all.slice(0, maxOthers);
  const base = cornersOf(trace, step.face);
  const apex = examined?.candidate.position ?? null;
  const isAccepted = examined?.candidate.verdict === "accepted";
  const failing = failingMarks({ trace, step, examined });
  const tip = normalOf(base, faceSize(trace, step.face));
  const labels: readonly LensLabel[] = [
    ...failing.labels,
    ...candidateLabel(examined),
    { kind: "base", position: mean(base), text: texts.base(step.face) },
    { kind: "ideal", position: step.idealPoint, text: texts.ideal },
    { kind: "base", position: tip[1] ?? base[0], text: texts.normal },
    ...others.flatMap(({ node, isNew, position }) =>
      isNew ? [] : [{ kind: "candidate" as const, position, text: texts.node(node), isMinor: true as const }],
    ),
  ];
  return {
    base,
    normal: tip,
    ideal: [step.idealPoint],
    candidate: apex ? [apex] : [],
    others: others.map(({ position }) => position),
    newSides: apex ? base.flatMap((corner) => [corner, apex]) : [],
    newFaces: apex ? base.flatMap((corner, i) => [corner, base[(i + 1) % 3] ?? corner, apex]) : [],
    isAccepted,
    supposed: supposed?.joined.flat() ?? [],
    rise: [],
    fans: [],
    refusedFans: [],
    made: [],
    ...failing,
    labels,
  };
}

const texts = playerStrings.marks;

/** An arrow from the centroid of a face into the empty volume. */
function normalOf(base: Triangle, size: number): readonly Position[] {
  const centroid = mean(base);
  const along = subtract(base[1], base[0]);
  const normal = unit(cross(along, subtract(base[2], base[0]))) ?? [0, 0, 1];
  const across = unit(along) ?? [1, 0, 0];
  const tip = addScaled(centroid, normal, normalLength * size);
  const behindTip = addScaled(tip, normal, -headLength * size);
  const barbs = [0.5, -0.5].flatMap((side) => [tip, addScaled(behindTip, across, side * headLength * size)]);
  return [centroid, tip, ...barbs];
}

function candidateLabel(examined: LensScene["examined"]): readonly LensLabel[] {
  if (!examined) return [];
  const { node, isNew, position, verdict } = examined.candidate;
  const kind = verdict === "behind" ? "failing" : "candidate";
  return [{ kind, position, text: texts.node(isNew ? null : node) }];
}

type FailingMarks = Pick<
  LensMarks,
  "culprit" | "pierced" | "failingSide" | "overlap" | "overlapOutline" | "crossing" | "labels"
>;

const noFailingMarks: FailingMarks = {
  culprit: [],
  pierced: [],
  failingSide: [],
  overlap: [],
  overlapOutline: [],
  crossing: [],
  labels: [],
};

/** What a refused candidate would break; nothing for an accepted one. */
function failingMarks({
  trace,
  step,
  examined,
}: Pick<LensScene, "trace" | "step" | "examined">): FailingMarks {
  const culprit = examined?.candidate.culprit ?? examined?.crossed[0];
  if (!examined) return noFailingMarks;
  if (examined.candidate.verdict === "behind")
    return { ...noFailingMarks, crossing: [examined.candidate.position] };
  if (culprit === undefined) return noFailingMarks;
  const { candidate, pair } = examined;
  const face = cornersOf(trace, culprit);
  const ofFace = { kind: "failing", position: mean(face), text: texts.face(culprit) } as const;
  if (candidate.verdict === "too-close") {
    const gap: Segment = [candidate.position, nearestOnFace(face, candidate.position)];
    const label = { kind: "failing", position: mean(gap), text: texts.tooClose } as const;
    return { ...noFailingMarks, culprit: face, failingSide: gap, labels: [ofFace, label] };
  }
  const element = newElement(trace, step.face, candidate.position, candidate.isNew ? null : candidate.node);
  const part = partInElement(element.corners, face);
  const [first] = part;
  return {
    culprit: face,
    pierced: pair && !pair.isNewSide ? pair.face : [],
    failingSide: pair?.side ?? [],
    overlap: first ? part.slice(2).flatMap((corner, i) => [first, part[i + 1] ?? first, corner]) : [],
    overlapOutline: part.flatMap((corner, i) => [corner, part[(i + 1) % part.length] ?? corner]),
    crossing: pair ? [pair.point] : [],
    labels: [
      ofFace,
      ...(pair ? [{ kind: "failing", position: pair.point, text: texts.crossing } as const] : []),
    ],
  };
}

/** How a part of the marks is drawn, in a colour of the view. Widths, diameters and dashes are in pixels. */
export type DrawnMark<Marks = LensMarks> = {
  readonly of: (marks: Marks) => readonly Position[];
  readonly color: "selection" | "failing" | "source" | "point" | "front" | "hover";
} & (
  | { readonly form: "faces"; readonly opacity: number }
  | { readonly form: "segments"; readonly width: number; readonly dash?: number }
  | { readonly form: "dots"; readonly size: number }
);

/** All parts of the marks, in the order in which they are drawn. What fails has a colour of its own. */
export const drawnMarks: readonly DrawnMark[] = [
  { form: "faces", of: ({ supposed }) => supposed, color: "point", opacity: 0.35 },
  {
    form: "faces",
    of: ({ isAccepted, newFaces }) => (isAccepted ? newFaces : []),
    color: "front",
    opacity: 0.22,
  },
  { form: "faces", of: ({ made }) => made, color: "front", opacity: 0.5 },
  { form: "faces", of: ({ base }) => base, color: "selection", opacity: 0.75 },
  { form: "faces", of: ({ culprit }) => culprit, color: "failing", opacity: 0.3 },
  { form: "faces", of: ({ pierced }) => pierced, color: "failing", opacity: 0.2 },
  { form: "faces", of: ({ overlap }) => overlap, color: "failing", opacity: 0.5 },
  { form: "segments", of: ({ culprit }) => edgesOf(culprit), color: "failing", width: 2.5 },
  { form: "segments", of: ({ pierced }) => edgesOf(pierced), color: "failing", width: 1.6 },
  {
    form: "segments",
    of: ({ isAccepted, newSides }) => (isAccepted ? newSides : []),
    color: "front",
    width: 2.5,
  },
  {
    form: "segments",
    of: ({ isAccepted, newSides }) => (isAccepted ? [] : newSides),
    color: "point",
    width: 1.8,
    dash: 9,
  },
  { form: "segments", of: ({ fans }) => fans, color: "point", width: 1.4, dash: 9 },
  { form: "segments", of: ({ refusedFans }) => refusedFans, color: "failing", width: 1.8, dash: 9 },
  { form: "segments", of: ({ rise }) => rise, color: "source", width: 2.5 },
  { form: "segments", of: ({ base }) => edgesOf(base), color: "selection", width: 4 },
  { form: "segments", of: ({ normal }) => normal, color: "selection", width: 2.5 },
  { form: "segments", of: ({ overlapOutline }) => overlapOutline, color: "point", width: 1.8 },
  { form: "segments", of: ({ failingSide }) => failingSide, color: "failing", width: 5 },
  { form: "dots", of: ({ others }) => others, color: "point", size: 8.5 },
  { form: "dots", of: ({ ideal }) => ideal, color: "source", size: 11 },
  { form: "dots", of: ({ candidate }) => candidate, color: "point", size: 13 },
  { form: "dots", of: ({ crossing }) => crossing, color: "failing", size: 14 },
];

/** The colour of the marks that each line of the legend is about. */
const legendColors = {
  base: "selection",
  ideal: "source",
  candidate: "point",
  failing: "failing",
} as const satisfies Record<MarkKind, DrawnMark["color"]>;

/** Returns the lines of the legend whose marks are drawn, by their kind. */
export function legendOf(marks: LensMarks): Readonly<Partial<Record<MarkKind, string>>> {
  const drawn = new Set(drawnMarks.filter(({ of }) => of(marks).length > 0).map(({ color }) => color));
  const kinds = (["base", "ideal", "candidate", "failing"] as const).filter((kind) =>
    drawn.has(legendColors[kind]),
  );
  return Object.fromEntries(kinds.map((kind) => [kind, texts.legend[kind]]));
}

/** The edges of triangles, two ends each. */
export const edgesOf = (corners: readonly Position[]): readonly Position[] =>
  corners.flatMap((corner, i) => [corner, corners[i % 3 === 2 ? i - 2 : i + 1] ?? corner]);

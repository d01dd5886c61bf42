/**
 * Reads the events of a trace, with the numbers as they are in the file: relative ones stay relative. The cursor is
 * behind the event's first byte.
 */
import {
  FRONT_CHANGES,
  type FrontChange,
  NEW_ACCEPTED_BIT,
  NEW_REFUSED_BIT,
  type Refusal,
  REFUSALS,
  REMESHING_BIT,
  RULE_CLASSES,
  SET_ASIDE,
  STRETCHED_BIT,
} from "./layout.js";
import type { RecordedScore } from "./score.js";
import type { TraceCursor } from "./trace-cursor.js";

/** x y z. */
export type Triple = readonly [number, number, number];
/** A symmetric tensor: xx, yy, zz, xy, xz, yz. */
export type TensorTerms = readonly [number, number, number, number, number, number];

export interface BaseEvent {
  readonly ruleClass: number;
  readonly isRemeshing: boolean;
  /** Number of the face minus that of the base face before it. */
  readonly face: number;
  readonly bucket: number;
  readonly layers: number;
  readonly targetEdge: number;
  readonly tensor: TensorTerms | null;
  /** Ideal point minus the face's first node. */
  readonly ideal: Triple;
  readonly nearbyFaces: number;
  readonly rankedCandidates: number;
}

/** Target edge length in a stretched field, where the size tensor has the size. */
const UNIT_EDGE = 1;

export function readBase(cursor: TraceCursor, detail: number): BaseEvent {
  const isStretched = (detail & STRETCHED_BIT) !== 0;
  const ruleClass = detail % STRETCHED_BIT;
  if (ruleClass >= RULE_CLASSES) cursor.fail(`there is no rule class ${ruleClass}`, cursor.at - 1);
  return {
    ruleClass,
    isRemeshing: (detail & REMESHING_BIT) !== 0,
    face: cursor.zigzag(),
    bucket: cursor.byte(),
    layers: cursor.varint(),
    targetEdge: isStretched ? UNIT_EDGE : cursor.float(),
    tensor: isStretched ? readTensor(cursor) : null,
    ideal: floats(cursor),
    nearbyFaces: cursor.varint(),
    rankedCandidates: cursor.varint(),
  };
}

/** A candidate: an existing node, by its number minus that of the base face's first node, or a new one. */
export type CandidateEvent =
  | { readonly isNew: false; readonly node: number }
  | { readonly isNew: true; readonly position: Triple };

/** Reads a score; files of earlier versions have other ones. */
export type ReadScore = (cursor: TraceCursor, isNew: boolean) => RecordedScore;

export interface RefusedEvent extends RecordedScore {
  readonly reason: Refusal;
  /** The position of a new node is relative to the base face's first node. */
  readonly candidate: CandidateEvent;
  /** Number of a face minus that of the base face; undefined for a candidate behind the base face. */
  readonly culprit: number | undefined;
}

export function readRefused(cursor: TraceCursor, detail: number, readScore: ReadScore): RefusedEvent {
  const isNew = (detail & NEW_REFUSED_BIT) !== 0;
  const reason = REFUSALS[detail - (isNew ? NEW_REFUSED_BIT : 0)];
  if (reason === undefined) return cursor.fail(`there is no reason ${detail} for a refusal`, cursor.at - 1);
  const score = readScore(cursor, isNew);
  const candidate: CandidateEvent = isNew
    ? { isNew, position: floats(cursor) }
    : { isNew, node: cursor.zigzag() };
  return { reason, ...score, candidate, culprit: reason === "behind" ? undefined : cursor.zigzag() };
}

export interface AcceptedEvent extends RecordedScore {
  /** The position of a new node is absolute. */
  readonly candidate: CandidateEvent;
  /** Per corner of the base face: whether the front has the element's face opposite it. */
  readonly has: readonly [boolean, boolean, boolean];
  /** Numbers minus that of the base face, of the faces that leave and then of those that join the front. */
  readonly faces: readonly number[];
}

export function readAccepted(cursor: TraceCursor, detail: number, readScore: ReadScore): AcceptedEvent {
  if (detail >= 2 * NEW_ACCEPTED_BIT)
    cursor.fail("the detail of an accepted candidate is wrong", cursor.at - 1);
  const isNew = (detail & NEW_ACCEPTED_BIT) !== 0;
  const score = readScore(cursor, isNew);
  const candidate: CandidateEvent = isNew
    ? { isNew, position: doubles(cursor) }
    : { isNew, node: cursor.zigzag() };
  const has = [(detail & 1) !== 0, (detail & 2) !== 0, (detail & 4) !== 0] as const;
  return { ...score, candidate, has, faces: [cursor.zigzag(), cursor.zigzag(), cursor.zigzag()] };
}

/** Returns the rule class under which a postponed face comes again; null if it is set aside. */
export function readPostponed(cursor: TraceCursor, detail: number): number | null {
  if (detail === SET_ASIDE) return null;
  return detail < RULE_CLASSES ? detail : cursor.fail(`there is no rule class ${detail}`, cursor.at - 1);
}

/** A list of items of an integer each, or of several: flat. */
export interface ChangeEvent {
  readonly change: FrontChange;
  readonly keptNodes: number;
  /** Positions, x y z each. */
  readonly newNodes: readonly number[];
  readonly leavingFaces: readonly number[];
  readonly keptElements: number;
  readonly removedElements: readonly number[];
  readonly restoredElements: readonly number[];
  /** Four nodes and the region per element. */
  readonly newElements: readonly number[];
  /** Number, three nodes and the region per face. */
  readonly joiningFaces: readonly number[];
}

export function readChange(cursor: TraceCursor, detail: number): ChangeEvent {
  const change = FRONT_CHANGES[detail];
  if (change === undefined) return cursor.fail(`there is no change ${detail}`, cursor.at - 1);
  return {
    change,
    keptNodes: cursor.varint(),
    newNodes: readNodes(cursor),
    leavingFaces: readAscending(cursor, "faces"),
    keptElements: cursor.varint(),
    removedElements: readAscending(cursor, "elements"),
    restoredElements: readAscending(cursor, "elements"),
    newElements: readElements(cursor),
    joiningFaces: readJoiningFaces(cursor),
  };
}

/** A face of a front that begins. */
export interface FirstFace {
  readonly nodes: readonly [number, number, number];
  readonly region: number;
}

/** Reads the faces of a front that begins, one after the other. */
export function* firstFacesIn(cursor: TraceCursor): Generator<FirstFace, void> {
  const count = cursor.count("faces", 4);
  let node = 0;
  const next = (): number => (node += cursor.zigzag());
  for (let i = 0; i < count; i++) yield { nodes: [next(), next(), next()], region: cursor.varint() };
}

function readNodes(cursor: TraceCursor): readonly number[] {
  const count = cursor.count("nodes", 24);
  return Array.from({ length: 3 * count }, () => cursor.double());
}

function readAscending(cursor: TraceCursor, what: string): readonly number[] {
  const count = cursor.count(what, 1);
  const numbers: number[] = [];
  let last = 0;
  for (let i = 0; i < count; i++) {
    const difference = cursor.varint();
    if (i > 0 && difference === 0) cursor.fail(`a list of ${what} has one of them twice`);
    numbers.push((last += difference));
  }
  return numbers;
}

function readElements(cursor: TraceCursor): readonly number[] {
  const count = cursor.count("elements", 5);
  const elements: number[] = [];
  let node = 0;
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < 4; k++) elements.push((node += cursor.zigzag()));
    elements.push(cursor.varint());
  }
  return elements;
}

function readJoiningFaces(cursor: TraceCursor): readonly number[] {
  const count = cursor.count("faces", 5);
  const faces: number[] = [];
  let number = 0;
  let node = 0;
  for (let i = 0; i < count; i++) {
    faces.push((number += cursor.zigzag()));
    for (let k = 0; k < 3; k++) faces.push((node += cursor.zigzag()));
    faces.push(cursor.varint());
  }
  return faces;
}

const floats = (cursor: TraceCursor): Triple => [cursor.float(), cursor.float(), cursor.float()];
const doubles = (cursor: TraceCursor): Triple => [cursor.double(), cursor.double(), cursor.double()];

function readTensor(cursor: TraceCursor): TensorTerms {
  return [cursor.float(), cursor.float(), cursor.float(), cursor.float(), cursor.float(), cursor.float()];
}

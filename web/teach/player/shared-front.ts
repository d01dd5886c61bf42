/** A state of the front of a model of the gallery, as an address names it. */
import { FRONT_ORDERS, type FrontOrder } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import type { CameraPose } from "../../viewer/camera";
import { frontColorings, type FrontColoring } from "./front-values";
import { frontFaces, shownElements, type FrontFaces, type ShownElements } from "./player";
import { surfaceState } from "./phases";

/** A state of a front, and how it is seen. */
export interface ShownFront {
  readonly step: number;
  /** Null for the order of the model. */
  readonly order: FrontOrder | null;
  readonly coloring: FrontColoring;
  readonly faces: FrontFaces;
  readonly elements: ShownElements;
  /** Candidate that the lens shows; null for the one that decides the step. */
  readonly candidate: number | null;
  /** Beat of the step's film, from 1; null for the state after the step. */
  readonly beat: number | null;
  /** Null for a camera that shows the whole model. */
  readonly camera: CameraPose | null;
}

export interface SharedFront extends ShownFront {
  /** Id of a model of the gallery. */
  readonly model: string;
}

/** Digits of the camera's coordinates. */
const digits = 5;

/** Returns the front that an address names, for example `?model=unit-cube&step=100`; null without a model or a step. */
export function sharedFrontIn(query: URLSearchParams): SharedFront | null {
  const model = query.get("model");
  const step = integerIn(query.get("step"));
  if (model === null || step === null) return null;
  return {
    model,
    step,
    order: FRONT_ORDERS.find((order) => order === query.get("order")) ?? null,
    ...viewIn({
      coloring: query.get("color"),
      faces: query.get("faces"),
      elements: query.get("elements"),
    }),
    candidate: countIn(query.get("candidate")),
    beat: beatIn(query.get("beat")),
    camera: cameraIn(query.get("camera")),
  };
}

/** Returns the front that a link to a project names, without the camera; null without a step. */
export function linkedFrontOf(linked: Readonly<Record<string, unknown>>): Omit<ShownFront, "camera"> | null {
  const { step, order, coloring, faces, elements, candidate, beat } = linked;
  if (!Number.isSafeInteger(step)) return null;
  return {
    step: Number(step),
    order: FRONT_ORDERS.find((each) => each === order) ?? "layered",
    ...viewIn({ coloring, faces, elements }),
    candidate: Number.isSafeInteger(candidate) && Number(candidate) >= 0 ? Number(candidate) : null,
    beat: Number.isSafeInteger(beat) && Number(beat) > 0 ? Number(beat) : null,
  };
}

/** How a front is drawn, by names that may be unknown. */
function viewIn(names: Readonly<Record<"coloring" | "faces" | "elements", unknown>>) {
  return {
    coloring: frontColorings.find((coloring) => coloring === names.coloring) ?? "age",
    faces: frontFaces.find((faces) => faces === names.faces) ?? "inside",
    elements: shownElements.find((elements) => elements === names.elements) ?? "recent",
  } as const;
}

/** Returns the parameters of an address; defaults are left out. */
export function queryOf(front: SharedFront): URLSearchParams {
  const { model, step, order, coloring, faces, elements, candidate, beat, camera } = front;
  const query = new URLSearchParams({ model, step: String(step) });
  if (order !== null) query.set("order", order);
  if (coloring !== "age") query.set("color", coloring);
  if (faces !== "inside") query.set("faces", faces);
  if (elements !== "recent") query.set("elements", elements);
  if (candidate !== null) query.set("candidate", String(candidate));
  if (beat !== null) query.set("beat", String(beat));
  if (camera) {
    const numbers = [...camera.eye, ...camera.target];
    query.set("camera", numbers.map((x) => Number(x.toPrecision(digits))).join(","));
  }
  return query;
}

/** Returns an address without the state of a front; a model stays. */
export function withoutFront(address: string): URL {
  const changed = new URL(address);
  for (const name of ["step", "order", "color", "faces", "elements", "candidate", "beat", "camera"])
    changed.searchParams.delete(name);
  return changed;
}

/** Returns the candidate if the step shown has tried it; else null. */
export function knownCandidate(trace: Trace, step: number, candidate: number | null): number | null {
  const state = surfaceState(trace, step);
  const shown = state === null ? trace.stepAt(step) : trace.surface?.stepAt(state);
  const count = shown?.kind === "advance" || shown?.kind === "edge" ? shown.candidates.length : 0;
  return candidate !== null && candidate < count ? candidate : null;
}

/** Steps of lines and patches are negative. */
export function integerIn(text: string | null): number | null {
  return text !== null && /^-?\d{1,9}$/.test(text) ? Number(text) : null;
}

function countIn(text: string | null): number | null {
  return text !== null && /^\d{1,9}$/.test(text) ? Number(text) : null;
}

function beatIn(text: string | null): number | null {
  return countIn(text) || null;
}

function cameraIn(text: string | null): CameraPose | null {
  const numbers = text?.split(",").map((part) => (part.trim() === "" ? NaN : Number(part))) ?? [];
  if (numbers.length !== 6 || !numbers.every(Number.isFinite)) return null;
  const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0] = numbers;
  // A camera needs a direction.
  if (a === d && b === e && c === f) return null;
  return { eye: [a, b, c], target: [d, e, f] };
}

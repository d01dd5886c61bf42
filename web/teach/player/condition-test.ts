/** Tests conditions on the steps of a trace, without decoding the steps. */
import type { PlanarFront, SurfaceTrace, Trace } from "tetrafront/trace";
import { refusals } from "./refusals";
import type { Position } from "../../document/position";
import { distance } from "../../document/vectors";
import type { Condition } from "./condition";
import { faceLayer, faceSize } from "./front-values";
import { surfaceState } from "./phases";

type Part<Kind extends Condition["kind"]> = Extract<Condition, { readonly kind: Kind }>;

/** A step as the conditions see it. */
interface TestedStep {
  /** Whether the step has the thing as base, tries it, makes it, or refuses a candidate because of it. */
  readonly isAbout: (thing: Part<"is">["thing"], index: number) => boolean;
  /** Value of a quantity; NaN if the step has none. */
  readonly valueOf: (quantity: Part<"compare">["quantity"]) => number;
  readonly happens: (what: Part<"happens">["what"]) => boolean;
  readonly refuses: (reason: Part<"refused">["reason"]) => boolean;
}

/** Returns whether a condition holds for a step (see phases.ts). O(parts · candidates of the step), without decoding it. */
export function holds(trace: Trace, step: number, condition: Condition): boolean {
  const state = surfaceState(trace, step);
  if (state === null) return step > 0 && test(volumeStep(trace, step), condition);
  return trace.surface !== null && test(surfaceStep(trace.surface, state), condition);
}

function test(step: TestedStep, condition: Condition): boolean {
  switch (condition.kind) {
    case "all":
      return condition.parts.every((part) => test(step, part));
    case "any":
      return condition.parts.some((part) => test(step, part));
    case "is":
      return step.isAbout(condition.thing, condition.index);
    case "compare":
      return compares(step.valueOf(condition.quantity), condition);
    case "happens":
      return step.happens(condition.what);
    case "refused":
      return step.refuses(condition.reason);
  }
}

function compares(value: number, { relation, value: limit }: Part<"compare">): boolean {
  switch (relation) {
    case "<":
      return value < limit;
    case "<=":
      return value <= limit;
    case ">":
      return value > limit;
    case ">=":
      return value >= limit;
    case "=":
      return value === limit;
  }
}

function volumeStep(trace: Trace, step: number): TestedStep {
  const { steps, faces } = trace;
  const face = steps.bases[step] ?? faces.born.length;
  const hasBase = face < faces.born.length;
  const range = [steps.firstCandidates[step] ?? 0, steps.firstCandidates[step + 1]] as const;
  const tried = (column: Uint32Array | Uint8Array) => column.subarray(...range);
  const made = (column: Uint32Array, index: number): boolean =>
    index >= (column[step - 1] ?? 0) && index < (column[step] ?? 0);
  return {
    isAbout: (thing, index) => {
      switch (thing) {
        case "face":
          return face === index || tried(steps.candidateCulprits).includes(index);
        case "node":
          return tried(steps.candidateNodes).includes(index);
        case "element":
          return made(steps.elementsMade, index);
        default:
          return false;
      }
    },
    valueOf: (quantity) => {
      switch (quantity) {
        case "size":
          return hasBase ? faceSize(trace, face) : NaN;
        case "layer":
          return hasBase ? faceLayer(trace, face) : NaN;
        case "candidates":
          return hasBase ? tried(steps.candidateNodes).length : NaN;
        case "front":
          return steps.frontSizes[step] ?? NaN;
      }
    },
    happens: (what) => {
      const outcome = steps.outcomes[step];
      if (what === "new node") return (steps.nodesMade[step] ?? 0) > (steps.nodesMade[step - 1] ?? 0);
      return what === (outcome === 0 ? "accepted" : outcome === 1 ? "postponed" : "recovery");
    },
    refuses: (reason) => {
      const verdicts = tried(steps.candidateVerdicts);
      if (reason === null) return verdicts.some((verdict) => verdict < refusals.length);
      const verdict = refusals.findIndex((refusal) => refusal === reason);
      return verdict >= 0 && verdicts.includes(verdict);
    },
  };
}

function surfaceStep(surface: SurfaceTrace, step: number): TestedStep {
  const kind = surface.kindAt(step);
  const front = surface.fronts[surface.frontAt(step) ?? -1];
  const { base, nodes, culprits } = surface.triedAt(step);
  return {
    isAbout: (thing, index) => {
      switch (thing) {
        case "edge":
          return base === index || culprits.includes(index);
        case "node":
          return nodes.includes(index);
        case "patch":
          return front?.patch === index - 1;
        case "line":
          return surface.divisions[surface.divisionAt(step) ?? -1]?.line === index - 1;
        default:
          return false;
      }
    },
    valueOf: (quantity) => {
      switch (quantity) {
        case "size":
          return front && base !== null ? edgeLength(front, base) : NaN;
        case "candidates":
          return base === null ? NaN : nodes.length;
        case "front":
          return front ? surface.frontSizeAt(step) : NaN;
        case "layer":
          return surface.layerAt(step) ?? NaN;
      }
    },
    happens: (what) => (what === "new node" ? surface.makesNode(step) : kind === what),
    refuses: (reason) => {
      const refusals = surface.refusalsAt(step);
      return reason === null ? refusals.some((refusal) => refusal) : refusals.includes(reason);
    },
  };
}

/** Length of an edge of a patch, in space. */
function edgeLength({ edges, positions }: PlanarFront, edge: number): number {
  const [from, to] = [edges[2 * edge] ?? 0, edges[2 * edge + 1] ?? 0].map((node): Position => {
    const [x = 0, y = 0, z = 0] = positions.subarray(3 * node, 3 * node + 3);
    return [x, y, z];
  });
  return from && to ? distance(from, to) : NaN;
}

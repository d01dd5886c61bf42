/** The header of a trace: JSON, checked against a schema. */
import * as v from "valibot";
import { objectWith, problemIn } from "../calls/schemas.js";
import { FRONT_ORDERS, type FrontOrder } from "../generated/constants.js";
import { experimentSchema, type FrontExperiment } from "./experiment.js";
import { TRACE_STATUSES, type TraceStatus } from "./layout.js";

const count = v.pipe(v.number(), v.safeInteger(), v.minValue(0), v.maxValue(0xffffffff));

const headerSchema = objectWith({
  name: v.string(),
  nodes: count,
  steps: count,
  order: v.picklist(FRONT_ORDERS),
  status: v.picklist(TRACE_STATUSES),
  fingerprint: v.pipe(v.string(), v.regex(/^[0-9a-f]{16}$/)),
  experiment: v.optional(experimentSchema),
});

/** What a trace says about itself. */
export interface TraceHeader {
  /** Name of the model. */
  readonly name: string;
  /** Number of nodes of the boundary. */
  readonly nodes: number;
  readonly steps: number;
  /** Order in which faces become base faces. */
  readonly order: FrontOrder;
  readonly status: TraceStatus;
  /** 16 hexadecimal digits: hash of the mesh when the front and its recovery have ended. */
  readonly fingerprint: string;
  /** Rules of the front that were given; absent for the usual ones. */
  readonly experiment?: FrontExperiment | undefined;
}

/** Returns the header, or a sentence about what is wrong with its text. */
export function parseHeader(text: string): { readonly header: TraceHeader } | { readonly problem: string } {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return { problem: "the header is no JSON" };
  }
  const problem = problemIn(headerSchema, value);
  if (problem === undefined) return { header: value as TraceHeader };
  const where = problem.path === "" ? "the header" : `"${problem.path}" of the header`;
  return { problem: `${where}: ${problem.message}` };
}

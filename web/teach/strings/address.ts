/** Texts about parameters of the page's address that cannot be used. */
import { FRONT_ORDERS } from "tetrafront";
import { shortened } from "../../strings/shortened";

/** An address can be of any length. */
const short = (value: string): string => shortened(value, 40);
const quoted = (name: string, value: string): string => `“${name}=${short(value)}”`;

export const addressStrings = {
  understood: "OK",
  step: (value: string) =>
    `The address should have a whole number as its step, but has ${quoted("step", value)}. No front is shown.`,
  stepAlone: (value: string) =>
    `The address has ${quoted("step", value)} without a model, for example “model=unit-cube”. No front is shown.`,
  withoutStep: (names: readonly string[]) =>
    `The address has ${names.map((name) => `“${name}”`).join(" and ")} without a step, for example “step=100”. No front is shown.`,
  noStep: (step: number, first: number, last: number, shown: number) =>
    `The front has no step ${step}: its states are ${first} to ${last}${first < 0 ? " (the negative ones belong to lines and patches)" : ""}. State ${shown} is shown.`,
  noCandidate: (candidate: number, step: number) =>
    `Step ${step} has no candidate ${candidate}. The candidate that decides the step is shown.`,
  noBeat: (beat: number, step: number, beats: number) =>
    `Step ${step} has ${beats === 0 ? "no beats" : `${beats} beats`}, and no beat ${beat}. The state after the step is shown.`,
  ofFront: {
    order: (value: string) =>
      `No order has the name in ${quoted("order", value)}; the orders are ${FRONT_ORDERS.join(", ")}. The model's own order is used.`,
    color: (value: string) =>
      `The colours are “age”, “size” or “layer”, but the address has ${quoted("color", value)}. Ages are shown.`,
    faces: (value: string) =>
      `The faces are “inside” or “all”, but the address has ${quoted("faces", value)}. Those seen from inside are shown.`,
    elements: (value: string) =>
      `The elements are “none”, “last”, “recent”, “all” or “cut”, but the address has ${quoted("elements", value)}. The last 60 are shown.`,
    candidate: (value: string) =>
      `The address should have a candidate from 0, but has ${quoted("candidate", value)}. The candidate that decides the step is shown.`,
    beat: (value: string) =>
      `The address should have a beat from 1, but has ${quoted("beat", value)}. The state after the step is shown.`,
    camera: (value: string) =>
      `A camera has six numbers, x, y and z of the eye and of what it looks at, but the address has ${quoted("camera", value)}. The whole model is shown.`,
  },
} as const;

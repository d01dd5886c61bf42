/** The rules of a run that is compared with others, and their names in addresses: `first-in`, `strict+linear`. */
import { FRONT_ORDERS, type FrontOrder } from "tetrafront";
import type { FrontSearch } from "tetrafront/trace";

export interface RunRules {
  /** Null for the order of the lesson. */
  readonly order: FrontOrder | null;
  /** Whether the rules are relaxed for a face that cannot be completed. */
  readonly relaxation: boolean;
  /** Whether cheap tests exclude faces before the full test for crossings. */
  readonly filters: boolean;
  /** Factor of the distance below which a new node is too close to a face. */
  readonly tolerance: number;
  readonly search: FrontSearch;
}

export const usualRules: RunRules = {
  order: null,
  relaxation: true,
  filters: true,
  tolerance: 1,
  search: "grid",
};

/** Tolerances to choose from. */
export const tolerances = [0, 0.5, 1, 2] as const;

const separator = "+";

/** Returns the name of rules: the parts that are not usual; an empty one if all are. */
export function nameOfRules({ order, relaxation, filters, tolerance, search }: RunRules): string {
  const parts = [
    order,
    relaxation ? null : "strict",
    filters ? null : "unfiltered",
    tolerance === usualRules.tolerance ? null : `tolerance-${tolerance}`,
    search === usualRules.search ? null : search,
  ];
  return parts.filter((part) => part !== null).join(separator);
}

/** Returns the rules of a name; null if a part of it is unknown. */
export function rulesNamed(name: string): RunRules | null {
  let rules: RunRules | null = usualRules;
  // A plus sign in an address stands for a space.
  for (const part of name.split(/[+ ]/).filter((text) => text !== "")) rules = rules && withPart(rules, part);
  return rules;
}

function withPart(rules: RunRules, part: string): RunRules | null {
  const order = FRONT_ORDERS.find((known) => known === part);
  if (order) return { ...rules, order };
  const tolerance = tolerances.find((known) => part === `tolerance-${known}`);
  if (tolerance !== undefined) return { ...rules, tolerance };
  switch (part) {
    case "strict":
      return { ...rules, relaxation: false };
    case "unfiltered":
      return { ...rules, filters: false };
    case "linear":
      return { ...rules, search: "linear" };
    default:
      return null;
  }
}

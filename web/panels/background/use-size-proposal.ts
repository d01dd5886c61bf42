import { useEffect, useState } from "react";
import type { SizeProposal } from "tetrafront";
import type { PROPOSAL_DEFAULTS } from "tetrafront/internal";
import { expectedTetrahedra } from "../../session/expected-tetrahedra";
import { useApp } from "../shared/app-context";
import { failureText } from "../../session/failure-text";

/** The options of a proposal that the user can change. */
export type ProposalFields = Readonly<Record<keyof typeof PROPOSAL_DEFAULTS, number>>;

/** The engine's answer to some options. */
export interface ProposalAnswer {
  readonly options: ProposalFields;
  readonly proposal: SizeProposal;
  /** Expected number of tetrahedra; null if the project cannot be meshed. */
  readonly tetrahedra: number | null;
}

export interface SizeProposalState {
  /** Null until the engine has answered. */
  readonly answer: ProposalAnswer | null;
  readonly failure: string | null;
}

/**
 * Requests proposed sizes and the expected number of tetrahedra from the engine. New options cancel the
 * previous request.
 */
export function useSizeProposal(options: ProposalFields): SizeProposalState {
  const app = useApp();
  const [answer, setAnswer] = useState<ProposalAnswer | null>(null);
  const [failure, setFailure] = useState<string | null>(null);
  useEffect(() => {
    const abort = new AbortController();
    const { signal } = abort;
    const ask = async (): Promise<void> => {
      const { project } = app.documents;
      const mesher = await app.mesher;
      const { uniform, smallest, elementsPerCircle, elementsPerGap, growth } = options;
      const proposal = await mesher.proposeSizes(
        project,
        {
          maxSize: uniform,
          minSize: smallest,
          anglePerEdge: elementsPerCircle && 360 / elementsPerCircle,
          layers: elementsPerGap,
          growth,
        },
        { signal },
      );
      const tetrahedra = await expectedTetrahedra(mesher, project, proposal, signal);
      setAnswer({ options, proposal, tetrahedra });
    };
    setFailure(null);
    ask().catch((error: unknown) => {
      if (!signal.aborted) setFailure(failureText(error));
    });
    return () => abort.abort();
  }, [app, options]);
  return { answer: answer?.options === options ? answer : null, failure };
}

/** Expected number of tetrahedra above which the dialog warns before it applies a proposal. */
export const manyTetrahedra = 500_000;

/** Additional factor on larger sizes, which compensates for the error of the expected count. */
const margin = 1.05;

/**
 * Returns options with a larger smallest size, for at most `manyTetrahedra`. The largest size also grows if it would be
 * below the smallest, or if the proposal has no sources.
 */
export function coarserOptions({ options, proposal, tetrahedra }: ProposalAnswer): ProposalFields {
  // The count falls with the cube of the size; in plates only with its square.
  const factor = margin * Math.sqrt((tetrahedra ?? 0) / manyTetrahedra);
  const round = (size: number): number => Number(size.toPrecision(2));
  const smallestSource = smallestSourceOf(proposal);
  if (smallestSource === null) return { ...options, uniform: round(factor * options.uniform) };
  const smallest = round(factor * Math.max(smallestSource, options.smallest));
  return { ...options, smallest, uniform: Math.max(smallest, options.uniform) };
}

/** Returns the smallest size of the proposed sources; null without sources. */
export function smallestSourceOf({ sources }: SizeProposal): number | null {
  return sources.reduce<number | null>((smallest, { size }) => Math.min(smallest ?? size, size), null);
}

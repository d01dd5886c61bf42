import { Facts } from "../../ui/facts";
import { formatCount, formatMeasure } from "../../strings/format";
import { strings } from "../../strings";
import { useProject, useRun } from "../shared/app-context";
import styles from "./proposal-summary.module.css";
import { smallestSourceOf, type ProposalAnswer, type SizeProposalState } from "./use-size-proposal";

const texts = strings.background;

/** The sizes and the number of tetrahedra of a proposal, beside those of the current mesh. */
export function ProposalSummary({ answer, failure }: SizeProposalState) {
  return (
    <div className={styles["summary"]} role="status" data-testid="proposal">
      {failure ?? (answer === null ? texts.analysing : <ProposalFacts answer={answer} />)}
    </div>
  );
}

function ProposalFacts({ answer: { proposal, tetrahedra } }: { readonly answer: ProposalAnswer }) {
  const current = useRun((state) => state.mesh?.report.tetrahedra ?? 0);
  const { units } = useProject();
  const smallest = smallestSourceOf(proposal);
  return (
    <Facts>
      <dt>{texts.largest}</dt>
      <dd>{formatMeasure(proposal.size, units)}</dd>
      <dt>{texts.sources}</dt>
      <dd data-testid="proposal-sources">{formatCount(proposal.sources.length)}</dd>
      {smallest !== null && (
        <>
          <dt>{texts.smallest}</dt>
          <dd>{formatMeasure(smallest, units)}</dd>
        </>
      )}
      <dt>{texts.expected}</dt>
      <dd data-testid="proposal-count">
        {tetrahedra === null
          ? strings.quality.unmeasured
          : texts.about(formatCount(Number(tetrahedra.toPrecision(2))))}
      </dd>
      {current > 0 && (
        <>
          <dt>{texts.currentMesh}</dt>
          <dd>{formatCount(current)}</dd>
        </>
      )}
    </Facts>
  );
}

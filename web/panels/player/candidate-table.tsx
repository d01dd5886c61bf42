import { strings } from "../../strings";
import tables from "../../ui/table.module.css";
import { useApp } from "../shared/app-context";
import styles from "./player.module.css";

const texts = strings.player;

/** A candidate: the number of its node, null for a new one; and the verdict in words. */
export interface CandidateRow {
  readonly name: number | null;
  /** With the digits that it has. */
  readonly score: string;
  readonly verdict: string;
}

interface CandidateTableProps {
  readonly label: string;
  readonly rows: readonly CandidateRow[];
  readonly chosen: number | null;
  /** What the scores mean. */
  readonly scoreHint: string;
}

/** The candidates in the order in which they were tried; a click examines one. */
export function CandidateTable({ label, rows, chosen, scoreHint }: CandidateTableProps) {
  const { player } = useApp();
  if (rows.length === 0) return null;
  return (
    <>
      <table className={`${tables["table"]} ${tables["compact"]}`} aria-label={label}>
        <thead>
          <tr>
            <th scope="col">{texts.candidate}</th>
            <th scope="col" title={scoreHint}>
              {texts.score}
            </th>
            <th scope="col">{texts.verdict}</th>
          </tr>
        </thead>
        <tbody>
          {rows.map(({ name, score, verdict }, i) => (
            // Candidates have no identity beside their rank.
            <tr key={i} data-highlighted={i === chosen || undefined}>
              <th scope="row">
                <button
                  type="button"
                  className={styles["candidate"]}
                  data-testid={`lens-candidate-${i}`}
                  aria-pressed={i === chosen}
                  onClick={() => player.state.setState({ candidate: i })}
                >
                  {texts.candidateName(i + 1, name)}
                </button>
              </th>
              <td>{score}</td>
              <td>{verdict}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {rows.length > 1 && <p className={styles["hint"]}>{scoreHint}</p>}
    </>
  );
}

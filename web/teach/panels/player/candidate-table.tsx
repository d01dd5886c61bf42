import { useFrontPlayer, usePlayer } from "./use-player";
import { useEffect, useRef, type ReactNode } from "react";
import { playerStrings } from "../../strings/player";
import tables from "../../../ui/table.module.css";
import { useShell } from "../../../panels/shared/app-context";
import { useLayout } from "../../../panels/shared/use-layout";
import styles from "./player.module.css";

const texts = playerStrings;

/** A candidate: the number of its node, null for a new one; and the verdict in words. */
export interface CandidateRow {
  readonly name: number | null;
  /** With the digits that it has. */
  readonly score: string;
  readonly verdict: string;
}

/** As in the style: more rows scroll, and leave their hint to the head of the column, so that formulas are in view. */
const ROWS_IN_VIEW = 4;

interface CandidateTableProps {
  readonly label: string;
  readonly rows: readonly CandidateRow[];
  readonly chosen: number | null;
  /** What the scores mean. */
  readonly scoreHint: string;
}

interface CandidatesAndFormulasProps extends CandidateTableProps {
  /** The formulas of the chosen one. */
  readonly children: ReactNode;
  /** Formulas of the step. */
  readonly further?: ReactNode;
}

/**
 * The candidates of a step, and the formulas of the chosen one. An audience sees the formulas first, and so does a phone, which has
 * room for one of both. Otherwise they follow the list, which keeps its place when another candidate is chosen.
 */
export function CandidatesAndFormulas({ children, further, ...props }: CandidatesAndFormulasProps) {
  const isPresenting = useShell((state) => state.isPresenting);
  const isFirst = useLayout() === "phone" || isPresenting;
  const count = props.rows.length;
  return (
    <>
      {isFirst && children}
      <CandidateTable {...props} />
      {!isFirst && children}
      {further}
      {count > 1 && count <= ROWS_IN_VIEW && <p className={styles["hint"]}>{props.scoreHint}</p>}
    </>
  );
}

/** The candidates in the order in which they were tried. The view highlights the one under the pointer or the focus; a click examines one. A long list scrolls: formulas follow it. */
function CandidateTable({ label, rows, chosen, scoreHint }: CandidateTableProps) {
  const player = useFrontPlayer();
  const pointed = usePlayer((state) => state.pointed);
  const point = (rank: number | null): void => player.state.setState({ pointed: rank });
  const list = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const shown = list.current;
    const row = shown?.querySelector<HTMLElement>("tr[data-highlighted]");
    if (!shown || !row) return;
    // The head of the table stays above the rows.
    const head = shown.querySelector("thead")?.offsetHeight ?? 0;
    const above = row.offsetTop - head;
    const below = row.offsetTop + row.offsetHeight - shown.clientHeight;
    shown.scrollTop = Math.max(below, Math.min(shown.scrollTop, above));
  }, [chosen, rows]);
  if (rows.length === 0) return null;
  return (
    <div ref={list} className={styles["candidates"]}>
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
            <tr
              key={i}
              data-highlighted={i === chosen || undefined}
              data-pointed={i === pointed || undefined}
              onPointerEnter={() => point(i)}
              onPointerLeave={() => point(null)}
            >
              <th scope="row">
                <button
                  type="button"
                  className={styles["candidate"]}
                  data-testid={`lens-candidate-${i}`}
                  aria-pressed={i === chosen}
                  onFocus={() => point(i)}
                  onBlur={() => point(null)}
                  onClick={() => player.choose(i)}
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
    </div>
  );
}

import type { Position } from "../../document/position";
import { formatPosition } from "../../strings/format";
import { TextButton } from "../../ui/text-button";
import { strings } from "../../strings";
import { useApp } from "./app-context";
import styles from "./position-list.module.css";

/** Largest number of positions listed; the summary states how many there are. */
const maxListed = 100;

export interface NamedPosition {
  readonly label: string;
  readonly position: Position;
}

export interface PositionListProps {
  readonly summary: string;
  readonly positions: readonly NamedPosition[];
  /** Number of positions, if not all are given. */
  readonly count?: number;
  readonly testId?: string;
}

/** A list that opens on demand, with buttons that mark each position and move the view to it. */
export function PositionList({ summary, positions, count = positions.length, testId }: PositionListProps) {
  const app = useApp();
  return (
    <details className={styles["positions"]}>
      <summary data-testid={testId}>{summary}</summary>
      <ul>
        {positions.slice(0, maxListed).map(({ label, position }, index) => (
          <li key={index}>
            <TextButton
              onClick={() => {
                app.shell.setState({ drawer: null });
                app.view.markPosition(position);
                app.viewer.getState().viewer?.framing.fitPosition(position);
              }}
            >
              {label}
            </TextButton>{" "}
            {strings.bottom.at(formatPosition(position))}
          </li>
        ))}
      </ul>
      {count > maxListed && strings.positions.more(count - maxListed)}
    </details>
  );
}

import { playerStrings } from "../../strings/player";
import styles from "./player.module.css";

interface BaseFactsProps {
  readonly title: string;
  readonly facts: readonly Fact[];
  readonly hint: string;
}

export interface Fact {
  readonly name: string;
  readonly value: string;
  /** What the name means: one sentence. */
  readonly meaning: string;
}

/** What is known about the base face or edge of a step. */
export function BaseFacts({ title, facts, hint }: BaseFactsProps) {
  return (
    <section aria-label={title}>
      <h2 className={styles["title"]}>{title}</h2>
      <dl className={styles["facts"]}>
        {facts.map(({ name, value, meaning }) => (
          <div key={name} title={meaning}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <p className={styles["hint"]}>{hint}</p>
      <details className={styles["meanings"]}>
        <summary>{playerStrings.meaningsTitle}</summary>
        <dl>
          {facts.map(({ name, meaning }) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{meaning}</dd>
            </div>
          ))}
        </dl>
      </details>
    </section>
  );
}

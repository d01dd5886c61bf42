import styles from "./player.module.css";

interface BaseFactsProps {
  readonly title: string;
  /** Names and values. */
  readonly facts: readonly (readonly [string, string])[];
  readonly hint: string;
}

/** What is known about the base face or edge of a step. */
export function BaseFacts({ title, facts, hint }: BaseFactsProps) {
  return (
    <section aria-label={title}>
      <h2 className={styles["title"]}>{title}</h2>
      <dl className={styles["facts"]}>
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <p className={styles["hint"]}>{hint}</p>
    </section>
  );
}

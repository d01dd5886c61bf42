import { Tooltip } from "@mantine/core";
import styles from "./explained.module.css";

interface ExplainedProps {
  readonly name: string;
  /** One or two sentences. */
  readonly meaning: string;
}

/** A name whose meaning is shown at the pointer, by a touch, and with the focus. */
export function Explained({ name, meaning }: ExplainedProps) {
  return (
    <Tooltip
      label={meaning}
      multiline
      w={280}
      events={{ hover: true, focus: true, touch: true }}
      classNames={{ tooltip: styles["meaning"] ?? "" }}
    >
      <span tabIndex={0} className={styles["explained"]}>
        {name}
      </span>
    </Tooltip>
  );
}

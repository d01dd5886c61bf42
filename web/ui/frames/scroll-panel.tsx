import type { ComponentPropsWithRef } from "react";
import styles from "./panel.module.css";

export interface ScrollPanelProps extends ComponentPropsWithRef<"div"> {
  /** Name of the panel for screen readers. */
  readonly label: string;
  readonly padded?: boolean;
}

/** A panel that scrolls if its content is too high, also with the keys. */
export function ScrollPanel({ label, padded = true, className, children, ...rest }: ScrollPanelProps) {
  const classes = [styles["scroll"], padded && styles["padded"], className].filter(Boolean);
  return (
    <div className={classes.join(" ")} tabIndex={0} role="region" aria-label={label} {...rest}>
      {children}
    </div>
  );
}

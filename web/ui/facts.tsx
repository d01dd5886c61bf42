import type { ReactNode } from "react";
import styles from "./facts.module.css";

/** Names on the left and values on the right: pairs of `dt` and `dd`. */
export function Facts({ children }: { readonly children: ReactNode }) {
  return <dl className={styles["facts"]}>{children}</dl>;
}

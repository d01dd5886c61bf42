import { UnstyledButton } from "@mantine/core";
import type { ComponentPropsWithoutRef } from "react";
import styles from "./text-button.module.css";

/** A button that looks like a link in running text. */
export function TextButton(props: ComponentPropsWithoutRef<"button">) {
  return <UnstyledButton {...props} className={styles["button"]} />;
}

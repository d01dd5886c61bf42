import { UnstyledButton } from "@mantine/core";
import type { ComponentPropsWithoutRef } from "react";
import styles from "./chip.module.css";

/** A small framed button. */
export function Chip(props: ComponentPropsWithoutRef<"button">) {
  return <UnstyledButton {...props} className={styles["chip"]} />;
}

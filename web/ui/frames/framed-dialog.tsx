import { Modal } from "@mantine/core";
import type { ReactNode } from "react";
import { useFocusReturn } from "../use-focus-return";
import styles from "./framed.module.css";
import { strings } from "../../strings";

export interface FramedDialogProps {
  readonly title: ReactNode;
  readonly opened: boolean;
  readonly size?: "md" | "lg" | "xl";
  readonly onClose: () => void;
  readonly children: ReactNode;
}

/** A dialog in the middle of the page. Its head is a `div`, because the page already has a `header` element. */
export function FramedDialog({ title, opened, size = "md", onClose, children }: FramedDialogProps) {
  useFocusReturn(opened);
  return (
    <Modal.Root opened={opened} size={size} returnFocus={false} onClose={onClose}>
      <Modal.Overlay backgroundOpacity={0.5} />
      <Modal.Content>
        <div className={styles["head"]}>
          <Modal.Title fw={600}>{title}</Modal.Title>
          <Modal.CloseButton aria-label={strings.messages.close} />
        </div>
        <Modal.Body>{children}</Modal.Body>
      </Modal.Content>
    </Modal.Root>
  );
}

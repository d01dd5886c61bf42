import { Modal } from "@mantine/core";
import type { ReactNode } from "react";
import { strings } from "./strings";

export interface FramedDialogProps {
  readonly title: ReactNode;
  readonly opened: boolean;
  readonly size?: "md" | "lg";
  readonly onClose: () => void;
  readonly children: ReactNode;
}

/** A dialog in the middle. Its head is no `header` element: the page has one already. */
export function FramedDialog({ title, opened, size = "md", onClose, children }: FramedDialogProps) {
  return (
    <Modal.Root opened={opened} size={size} onClose={onClose}>
      <Modal.Overlay backgroundOpacity={0.5} />
      <Modal.Content>
        <div className="tf-dialog-head">
          <Modal.Title fw={600}>{title}</Modal.Title>
          <Modal.CloseButton aria-label={strings.messages.close} />
        </div>
        <Modal.Body>{children}</Modal.Body>
      </Modal.Content>
    </Modal.Root>
  );
}

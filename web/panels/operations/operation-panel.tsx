import { Button, Group, Text } from "@mantine/core";
import { useMergedRef } from "@mantine/hooks";
import { useRef, type KeyboardEvent, type Ref } from "react";
import { useStore } from "zustand";
import { acceptOperation } from "../../commands/operation-commands";
import type { OpenOperation } from "../../session/operations";
import { operationStrings } from "../../strings";
import { ApplyButton, DialogForm } from "../../ui/frames/dialog-form";
import { useApp } from "../shared/app-context";
import { OperationField } from "./operation-field";
import { useFirstFocus } from "./use-first-focus";
import styles from "./operation-panel.module.css";

/** The values of the open operation, beside what they give in the view. Enter accepts them, Escape cancels. */
export function OperationPanel({ ref }: { readonly ref: Ref<HTMLElement> }) {
  const app = useApp();
  const open = useStore(app.operations.state, (state) => state.open);
  return open && <OperationForm key={open.operation.id} ref={ref} open={open} />;
}

function OperationForm({ ref, open }: { readonly ref: Ref<HTMLElement>; readonly open: OpenOperation }) {
  const app = useApp();
  const { operation, values, expressions, subject, reason, entities, isPending } = open;
  const notes = [operation.note?.(values, subject, expressions) ?? "", open.note].filter(
    (note) => note !== "",
  );
  const box = useRef<HTMLElement>(null);
  const frame = useMergedRef(box, ref);
  useFirstFocus(box);
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    app.operations.cancel();
  };
  return (
    <section
      ref={frame}
      className={styles["panel"]}
      aria-label={operation.title}
      data-testid="operation"
      data-operation={operation.id}
      data-pending={isPending || undefined}
      onKeyDown={onKeyDown}
    >
      <div className={styles["content"]} data-presented>
        <h2 className={styles["title"]}>{operation.title}</h2>
        <DialogForm onApply={() => acceptOperation(app)}>
          <div className={styles["fields"]}>
            {operation.fields(values, subject).map((spec) => (
              <OperationField key={spec.key} spec={spec} open={open} />
            ))}
          </div>
          {notes.length > 0 && (
            <Text size="xs" c="dimmed" data-testid="operation-note">
              {notes.join(" ")}
            </Text>
          )}
          <Text className={styles["result"]} role="status" data-refused={reason !== null || undefined}>
            {isPending ? operationStrings.computing : (reason ?? operationStrings.result(entities))}
          </Text>
          <Group justify="flex-end" gap="xs" className={styles["actions"]}>
            <Button size="xs" variant="default" onClick={() => app.operations.cancel()}>
              {operationStrings.cancel}
            </Button>
            <ApplyButton disabled={reason !== null} data-testid="accept">
              {operation.action}
            </ApplyButton>
          </Group>
        </DialogForm>
      </div>
    </section>
  );
}

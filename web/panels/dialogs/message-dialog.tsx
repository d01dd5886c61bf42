import { Button, List } from "@mantine/core";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { strings } from "../../strings";
import { useApp, useShell } from "../shared/app-context";

/** A message that no panel shows. */
export function MessageDialog() {
  const app = useApp();
  const message = useShell((state) => state.message);
  const close = (): void => app.shell.setState({ message: null });
  return (
    <FramedDialog opened={message !== null} title={message?.title} onClose={close}>
      <List size="sm" spacing={4} data-testid="message">
        {message?.lines.map((line) => (
          <List.Item key={line}>{line}</List.Item>
        ))}
      </List>
      <Button mt="md" onClick={close} data-autofocus>
        {strings.messages.close}
      </Button>
    </FramedDialog>
  );
}

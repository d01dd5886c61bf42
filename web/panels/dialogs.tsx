import { Button, Kbd, List, Text } from "@mantine/core";
import { commands, keyNames } from "../commands/registry";
import { SectionTitle } from "../ui/field-row";
import { FramedDialog } from "../ui/framed-dialog";
import { strings } from "../ui/strings";
import { useApp, useShell } from "./app-context";

/** Keys and mouse, from the same registry as everything else. */
export function HelpDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "help");
  const keyed = commands.filter(({ keys }) => keys.length > 0);
  return (
    <FramedDialog
      opened={opened}
      size="lg"
      title={strings.help.title}
      onClose={() => app.shell.setState({ dialog: null })}
    >
      <div className="tf-help">
        <dl>
          {[...strings.help.mouse, ...strings.help.fields].map(([what, effect]) => (
            <div key={what}>
              <dt>{what}</dt>
              <dd>{effect}</dd>
            </div>
          ))}
        </dl>
        <dl>
          {keyed.map((command) => (
            <div key={command.id}>
              <dt>
                {command.keys.map((key) => (
                  <Kbd key={key} size="xs">
                    {keyNames(key).join(" ")}
                  </Kbd>
                ))}
              </dt>
              <dd>{command.label(app)}</dd>
            </div>
          ))}
        </dl>
      </div>
      <SectionTitle>{strings.appName}</SectionTitle>
      <Text size="sm" c="dimmed">
        {strings.help.about}
      </Text>
    </FramedDialog>
  );
}

/** What went wrong and is said nowhere else on the page. */
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

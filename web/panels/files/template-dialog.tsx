import { Text, UnstyledButton } from "@mantine/core";
import { openTemplate } from "../../commands/project-actions";
import { templates } from "../../document/templates";
import { templateStrings as texts } from "../../strings";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { useApp, useShell } from "../shared/app-context";
import styles from "./template-dialog.module.css";

/** Projects to begin with. */
export function TemplateDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "templates");
  const close = (): void => app.shell.setState({ dialog: null });
  return (
    <FramedDialog opened={opened} title={texts.title} onClose={close}>
      <Text size="sm" c="dimmed" mb="sm">
        {texts.hint}
      </Text>
      <ul className={styles["list"]}>
        {templates.map(({ id, make }) => (
          <li key={id}>
            <UnstyledButton
              className={styles["template"]}
              data-testid={`template-${id}`}
              onClick={() => {
                close();
                openTemplate(app, make());
              }}
            >
              <Text fw={600} size="sm" component="span">
                {texts.templates[id].title}
              </Text>
              <Text size="sm" c="dimmed" component="span">
                {texts.templates[id].blurb}
              </Text>
            </UnstyledButton>
          </li>
        ))}
      </ul>
    </FramedDialog>
  );
}

import { Anchor, Kbd, Text } from "@mantine/core";
import libraryLicense from "occt-import-js/dist/license.occt-import-js.txt?url";
import openCascadeLicense from "occt-import-js/dist/license.occt.txt?url";
import { commands, keyNames } from "../../commands/registry";
import { SectionTitle } from "../../ui/frames/section-title";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { strings } from "../../strings";
import { useApp, useShell } from "../shared/app-context";
import styles from "./help-dialog.module.css";

/** All keys and mouse actions; those of commands come from the registry. */
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
      <div className={styles["columns"]}>
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
      <Text size="sm" c="dimmed">
        {strings.help.cadLibrary}{" "}
        <Anchor href={openCascadeLicense} target="_blank">
          OpenCascade
        </Anchor>
        {", "}
        <Anchor href={libraryLicense} target="_blank">
          occt-import-js
        </Anchor>
        {"."}
      </Text>
    </FramedDialog>
  );
}

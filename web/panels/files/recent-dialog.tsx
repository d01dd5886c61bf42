import { ActionIcon, Text, UnstyledButton } from "@mantine/core";
import { IconTrash } from "@tabler/icons-react";
import { openRecent } from "../../commands/project-actions";
import type { RecentDocument } from "../../session/document-library";
import { formatTime } from "../../strings/format";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { strings } from "../../strings";
import { useApp, useShell } from "../shared/app-context";
import { DocumentPicture } from "./document-picture";
import { useRecentDocuments } from "./use-recent";
import styles from "./recent-dialog.module.css";

const texts = strings.recent;

/** The documents in the browser's storage, with buttons that open or remove them. */
export function RecentDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "recent");
  return (
    <FramedDialog opened={opened} title={texts.title} onClose={() => app.shell.setState({ dialog: null })}>
      <RecentList />
    </FramedDialog>
  );
}

/** Mounted only while the dialog is open. */
function RecentList() {
  const { documents, failure, remove } = useRecentDocuments();
  if (failure !== null) return <Text role="alert">{failure}</Text>;
  if (documents === null) return <Text c="dimmed">{texts.loading}</Text>;
  return (
    <>
      <Text size="sm" c="dimmed" mb="sm">
        {documents.length > 0 ? texts.hint : texts.none}
      </Text>
      <ul className={styles["list"]}>
        {documents.map((document) => (
          <RecentRow key={document.id} document={document} onRemove={() => remove(document.id)} />
        ))}
      </ul>
    </>
  );
}

interface RecentRowProps {
  readonly document: RecentDocument;
  readonly onRemove: () => void;
}

function RecentRow({ document: { id, name, at, openIn }, onRemove }: RecentRowProps) {
  const app = useApp();
  return (
    <li className={styles["row"]}>
      <UnstyledButton
        className={styles["open"]}
        disabled={openIn !== null}
        data-testid={`recent-${id}`}
        onClick={() => void openRecent(app, id, name)}
      >
        <DocumentPicture id={id} />
        <span className={styles["name"]}>{name}</span>
        <span className={styles["time"]}>{openIn ? texts.openIn[openIn] : formatTime(at, Date.now())}</span>
      </UnstyledButton>
      <ActionIcon
        variant="subtle"
        color="gray"
        aria-label={texts.remove(name)}
        disabled={openIn !== null}
        onClick={onRemove}
      >
        <IconTrash size={16} aria-hidden />
      </ActionIcon>
    </li>
  );
}

import { Button, Group, Text, Textarea } from "@mantine/core";
import { IconCopy, IconDeviceFloppy } from "@tabler/icons-react";
import { useEffect, useRef, useState, type Ref } from "react";
import { save } from "../../commands/project-actions";
import { maxLinkLength } from "../../commands/project-link";
import { linkStrings as texts } from "../../strings/passing";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { useApp, useShell } from "../shared/app-context";

/** The link to the open project. */
export function ShareDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "share");
  return (
    <FramedDialog opened={opened} title={texts.title} onClose={() => app.shell.setState({ dialog: null })}>
      <ShareForm />
    </FramedDialog>
  );
}

type Link =
  | { readonly kind: "made"; readonly text: string }
  | { readonly kind: "failed"; readonly reason: string };

/** Mounted only while the dialog is open. */
function ShareForm() {
  const app = useApp();
  const link = useLink();
  const [isCopied, setCopied] = useState(false);
  const text = link?.kind === "made" ? link.text : null;
  const button = useRef<HTMLButtonElement>(null);
  const isTooLong = text !== null && text.length > maxLinkLength;
  useEffect(() => {
    // Most people open the dialog to copy the link. Without the permission, the button is left.
    if (text !== null && !isTooLong) void copy(text).then(setCopied);
    // The link is made after the dialog has got the focus.
    if (text !== null) button.current?.focus();
  }, [text, isTooLong]);
  if (link?.kind === "failed") return <Text role="alert">{`${texts.failed}: ${link.reason}`}</Text>;
  if (text === null) return <Text c="dimmed">{texts.making}</Text>;
  if (isTooLong) return <TooLong button={button} length={text.length} />;
  return (
    <>
      <Text size="sm">
        {texts.intro}
        {app.replay.state.getState().isShown && ` ${texts.withStep}`}
      </Text>
      <Textarea
        mt="sm"
        aria-label={texts.field}
        data-testid="share-link-text"
        readOnly
        rows={4}
        value={text}
        onFocus={(event) => event.currentTarget.select()}
      />
      <Group mt="sm" justify="space-between">
        <Text size="sm" c="dimmed" role="status" data-testid="share-link-length">
          {`${texts.length(text.length)}${isCopied ? `. ${texts.copied}` : ""}`}
        </Text>
        <Button
          size="xs"
          ref={button}
          data-testid="share-link-copy"
          leftSection={<IconCopy size={15} aria-hidden />}
          onClick={() => void copy(text).then(setCopied)}
        >
          {texts.copy}
        </Button>
      </Group>
    </>
  );
}

interface TooLongProps {
  readonly button: Ref<HTMLButtonElement>;
  readonly length: number;
}

function TooLong({ button, length }: TooLongProps) {
  const app = useApp();
  return (
    <>
      <Text size="sm" role="alert" data-testid="share-link-too-long">
        {texts.tooLong(length, maxLinkLength)}
      </Text>
      <Group mt="sm" justify="flex-end">
        <Button
          ref={button}
          size="xs"
          leftSection={<IconDeviceFloppy size={15} aria-hidden />}
          onClick={() => void save(app, true)}
        >
          {texts.save}
        </Button>
      </Group>
    </>
  );
}

/** Returns the link, made once; null while it is being made. */
function useLink(): Link | null {
  const app = useApp();
  const [link, setLink] = useState<Link | null>(null);
  useEffect(() => {
    let isShown = true;
    void import("../../commands/share-actions")
      .then(({ projectLink }) => projectLink(app))
      .then(
        (text): Link => ({ kind: "made", text }),
        (error: unknown): Link => ({ kind: "failed", reason: String(error) }),
      )
      .then((made) => {
        if (isShown) setLink(made);
      });
    return () => {
      isShown = false;
    };
  }, [app]);
  return link;
}

/** Returns whether the text is in the clipboard. */
const copy = (text: string): Promise<boolean> =>
  navigator.clipboard.writeText(text).then(
    () => true,
    () => false,
  );

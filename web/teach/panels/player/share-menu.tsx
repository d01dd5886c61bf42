import { ActionIcon, Menu } from "@mantine/core";
import { IconShare } from "@tabler/icons-react";
import { shareStrings as texts } from "../../strings/share";
import { useApp } from "../../../panels/shared/app-context";

const actions = () => import("../../commands/step-links");
const pictures = () => import("../../commands/step-pictures");

/** Links to the step that is shown, and files of it. */
export function ShareMenu() {
  const app = useApp();
  return (
    <Menu position="top-end">
      <Menu.Target>
        <ActionIcon
          size={24}
          variant="subtle"
          color="gray"
          aria-label={texts.share}
          data-testid="player-share"
        >
          <IconShare size={15} aria-hidden />
        </ActionIcon>
      </Menu.Target>
      <Menu.Dropdown>
        <Menu.Item
          data-testid="share-step-link"
          onClick={() => void actions().then(({ copyLink }) => copyLink(app))}
        >
          {texts.link}
        </Menu.Item>
        <Menu.Item
          data-testid="share-embed"
          onClick={() => void actions().then(({ copyEmbedCode }) => copyEmbedCode(app))}
        >
          {texts.embed}
        </Menu.Item>
        <Menu.Divider />
        <Menu.Item
          data-testid="share-png"
          onClick={() => void pictures().then(({ savePicture }) => savePicture(app))}
        >
          {texts.picture}
        </Menu.Item>
        <Menu.Item
          data-testid="share-svg"
          onClick={() => void pictures().then(({ saveDrawing }) => saveDrawing(app))}
        >
          {texts.drawing}
        </Menu.Item>
        <Menu.Item
          data-testid="share-webm"
          onClick={() => void pictures().then(({ saveAnimation }) => saveAnimation(app))}
        >
          {texts.animation}
        </Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}

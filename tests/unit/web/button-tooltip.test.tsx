// @vitest-environment happy-dom
/** The tooltip of a button, which must not cover what the button opens. */
import { MantineProvider } from "@mantine/core";
import { createRoot, type Root } from "react-dom/client";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { IconButton } from "../../../web/ui/icon-button";

let host: HTMLElement;
let root: Root;
const until = (check: () => void): Promise<void> => vi.waitFor(check, { timeout: 60_000 });
const button = (): HTMLElement | null => host.querySelector("button");
const tooltip = (): string => document.querySelector('[role="tooltip"]')?.textContent ?? "";

beforeEach(async () => {
  host = document.body.appendChild(document.createElement("div"));
  root = createRoot(host);
  root.render(
    <MantineProvider env="test">
      <IconButton label="Type coordinates">x</IconButton>
    </MantineProvider>,
  );
  await until(() => expect(button()).not.toBeNull());
});
afterEach(() => {
  root.unmount();
  host.remove();
});

function enter(): void {
  const init = { bubbles: true, pointerType: "mouse", relatedTarget: document.body };
  button()?.dispatchEvent(new PointerEvent("pointerover", init));
  button()?.dispatchEvent(new MouseEvent("mouseenter"));
  button()?.dispatchEvent(new MouseEvent("mousemove", { bubbles: true }));
}

function leave(): void {
  button()?.dispatchEvent(
    new PointerEvent("pointerout", { bubbles: true, pointerType: "mouse", relatedTarget: document.body }),
  );
  button()?.dispatchEvent(new MouseEvent("mouseleave"));
}

it("disappears when the button is pressed, and appears when the pointer comes back", async () => {
  enter();
  await until(() => expect(tooltip()).toBe("Type coordinates"));
  button()?.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true, pointerType: "mouse" }));
  button()?.click();
  await until(() => expect(tooltip()).toBe(""));
  leave();
  enter();
  await until(() => expect(tooltip()).toBe("Type coordinates"));
});

it("does not appear after the button was pressed", async () => {
  enter();
  button()?.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true, pointerType: "mouse" }));
  await new Promise((resolve) => setTimeout(resolve, 600));
  expect(tooltip()).toBe("");
});

import { readFileSync } from "node:fs";
import { expect, type Page } from "@playwright/test";

/** Numbers of actions per task, as docs/ACTIONS.md states them: the last column of its table. */
function statedActions(task: string): number | undefined {
  const text = readFileSync(new URL("../../docs/ACTIONS.md", import.meta.url), "utf8");
  const row = text.split("\n").find((line) => line.startsWith(`| ${task} `));
  const last = row?.split("|").at(-2)?.trim();
  return last === undefined ? undefined : Number(last);
}

/**
 * Counts the user's actions from the next page on, in the page itself: a press of a pointer button, a press of a key or a
 * combination of keys, and a text that is typed into one field without a pause by another action.
 */
export async function countActions(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const counted = {
      actions: 0,
      typingIn: null as EventTarget | null,
      isKeyed: false,
      /** Coordinates are being typed in the view: their field opens at the first key, on a busy machine some keys later. */
      isOpening: false,
    };
    Object.assign(window, { countedActions: counted });
    const act = (typingIn: EventTarget | null): void => {
      if (typingIn === null || typingIn !== counted.typingIn) ++counted.actions;
      counted.typingIn = typingIn;
      counted.isOpening = false;
    };
    addEventListener("pointerdown", () => act(null), true);
    addEventListener(
      "keydown",
      ({ key, ctrlKey, metaKey, altKey, repeat, target }) => {
        if (repeat || ["Control", "Shift", "Alt", "Meta"].includes(key)) return;
        const isText = key.length === 1 && !ctrlKey && !metaKey && !altKey;
        const isField = target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement;
        counted.isKeyed = isText && isField;
        if (counted.isOpening && isText) {
          if (isField) {
            counted.typingIn = target;
            counted.isOpening = false;
          }
          return;
        }
        act(isText && isField ? target : null);
        counted.isOpening = isText && !isField && /[\d@.+(-]/.test(key);
      },
      true,
    );
    addEventListener(
      "input",
      ({ target }) => {
        // Tests fill fields without keys.
        const isText = target instanceof HTMLInputElement && target.type === "text";
        if (isText && counted.isOpening) {
          counted.typingIn = target;
          counted.isOpening = false;
        } else if (isText && !counted.isKeyed) act(target);
        counted.isKeyed = false;
      },
      true,
    );
  });
}

/** Begins to count again. */
export async function forgetActions(page: Page): Promise<void> {
  await page.evaluate(() => {
    const { countedActions } = window as unknown as { readonly countedActions?: object };
    if (countedActions) Object.assign(countedActions, { actions: 0, typingIn: null });
  });
}

/** Relative difference from the stated number: on a busy machine, a text that is typed may be counted as two. */
const tolerance = 0.1;

/** Checks that a task took as many actions as the documentation states. */
export async function expectActions(page: Page, task: string): Promise<void> {
  const actions = await page.evaluate(
    () => (window as unknown as { countedActions: { actions: number } }).countedActions.actions,
  );
  const stated = statedActions(task) ?? NaN;
  const difference = Math.abs(actions - stated);
  expect(difference, `actions of the task "${task}", beside those in docs/ACTIONS.md`).toBeLessThanOrEqual(
    tolerance * stated,
  );
}

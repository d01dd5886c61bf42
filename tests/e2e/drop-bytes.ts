import type { Page } from "@playwright/test";

/** Drops a file on the page. */
export async function dropBytes(page: Page, bytes: Uint8Array, fileName: string): Promise<void> {
  await page.evaluate(
    ([base64, name]) => {
      const content = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      const transfer = new DataTransfer();
      transfer.items.add(new File([content], name));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
    },
    [Buffer.from(bytes).toString("base64"), fileName] as const,
  );
}

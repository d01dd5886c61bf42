import type { Page } from "@playwright/test";

/** Drops a file on the page. */
export async function dropBytes(page: Page, bytes: Uint8Array, fileName: string): Promise<void> {
  await dropFiles(page, { [fileName]: bytes });
}

/** Drops files on the page at once. `files`: bytes by name. */
export async function dropFiles(page: Page, files: Readonly<Record<string, Uint8Array>>): Promise<void> {
  await page.evaluate(
    (dropped) => {
      const transfer = new DataTransfer();
      for (const [name, base64] of dropped) {
        const content = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
        transfer.items.add(new File([content], name));
      }
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
    },
    Object.entries(files).map(([name, bytes]) => [name, Buffer.from(bytes).toString("base64")] as const),
  );
}

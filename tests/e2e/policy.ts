import type { Page } from "@playwright/test";

/** Records what the Content-Security-Policy of the page refuses, from its first script on; also after a reload. */
export async function recordRefusals(page: Page): Promise<() => Promise<readonly string[]>> {
  const refused: string[] = [];
  await page.exposeFunction("noteRefusal", (what: string) => void refused.push(what));
  await page.addInitScript(() => {
    const { noteRefusal } = window as unknown as { readonly noteRefusal: (what: string) => void };
    document.addEventListener("securitypolicyviolation", (event) => {
      noteRefusal(
        `${event.effectiveDirective} ${event.blockedURI} ${event.sourceFile}:${event.lineNumber} ${event.sample}`,
      );
    });
  });
  return () => Promise.resolve(refused);
}

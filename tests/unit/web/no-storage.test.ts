import { afterEach, expect, it, vi } from "vitest";
import { BrowserStorage } from "../../../web/session/document-storage";
import { strings } from "../../../web/strings";

afterEach(() => void vi.unstubAllGlobals());

/** What a browser does whose storage is missing, blocked, or refused as in a private window. */
const browsers = {
  "has no IndexedDB": undefined,
  "blocks site data": {
    open: () => {
      throw new DOMException("The operation is insecure.", "SecurityError");
    },
  },
  "is in a private window": {
    open: () => {
      throw new DOMException("A mutation operation was attempted on a database.", "InvalidStateError");
    },
  },
} as const;

it.each(Object.entries(browsers))(
  "in a browser that %s, the reason is a sentence for the user",
  async (_, indexedDB) => {
    vi.stubGlobal("indexedDB", indexedDB);
    const storage = new BrowserStorage();
    const reason = await storage.listUntouched().then(
      () => "",
      (error: unknown) => (error as Error).message,
    );
    expect(reason).toMatch(/^[A-Z][^:]*\.$/);
    expect(reason).not.toMatch(/indexedDB|undefined|operation/i);
    const notice = strings.notices.autosaveFailed(reason);
    expect(notice).toContain(reason);
    expect(notice).toMatch(/Save the project to a file/);
    expect(notice).not.toMatch(/keeps trying|\.\./);
  },
);

it("in a browser that throws when its storage is looked for, the reason is the same sentence", async () => {
  vi.stubGlobal("indexedDB", undefined);
  Object.defineProperty(globalThis, "indexedDB", {
    configurable: true,
    get: () => {
      throw new DOMException("denied", "SecurityError");
    },
  });
  await expect(new BrowserStorage().listUntouched()).rejects.toThrow(strings.notices.noStorage);
});

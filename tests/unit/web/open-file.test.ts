import { expect, test, vi } from "vitest";

import { openDocumentFile, readDocumentFile } from "../../../web/session/files.js";

const fileOpen = vi.hoisted(() => vi.fn<() => Promise<File>>());
vi.mock("browser-fs-access", () => ({ fileOpen }));

const open = () => openDocumentFile("documents", () => undefined);
const refused = () => Promise.reject(new DOMException("no click or key before", "NotAllowedError"));

test("a file that cannot be read, such as a folder, is reported", async () => {
  const folder = Object.assign(new File([], "parts.json"), {
    text: () => Promise.reject(new Error("it is a folder")),
  });
  expect(await readDocumentFile(folder, () => undefined)).toEqual({
    kind: "failed",
    fileName: "parts.json",
    reasons: ["Error: it is a folder"],
  });
});

test("a second request while the dialog is open is cancelled; any other rejection by the browser is an error", async () => {
  let choose: (file: File) => void = () => undefined;
  fileOpen.mockReturnValueOnce(new Promise((resolve) => (choose = resolve)));
  const first = open();
  await vi.waitFor(() => expect(fileOpen).toHaveBeenCalledOnce());
  fileOpen.mockImplementation(refused);
  expect(await open()).toEqual({ kind: "cancelled" });
  choose(new File(["no project"], "parts.json"));
  expect(await first).toMatchObject({ kind: "failed", fileName: "parts.json" });
  await expect(open()).rejects.toThrow("no click or key before");
});

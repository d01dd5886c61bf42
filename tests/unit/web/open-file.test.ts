import { expect, test, vi } from "vitest";

import { cubeProject } from "../../support/projects.js";
import {
  failureLines,
  openDocumentFile,
  readDocumentFile,
  readDroppedFiles,
} from "../../../web/session/files.js";

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

test.each([
  ["notes.txt", "some text"],
  ["picture.png", "\u0089PNG"],
  ["README", "no extension"],
  ["table.csv", "1,2,3"],
  ["empty.xyz", ""],
])("%s is refused with the formats that can be opened", async (name, content) => {
  const result = await readDocumentFile(new File([content], name), () => undefined);
  if (result.kind !== "failed") throw new Error("it was opened");
  const text = failureLines([result]).join("\n");
  for (const extension of [".json", ".step", ".iges", ".stl", ".obj", ".ply", ".3mf", ".vtu", ".msh"])
    expect(text).toContain(extension);
  const [end] = /\.\w+$/.exec(name) ?? [""];
  expect(result.reasons[0]).toContain(end === "" ? "without an extension" : end);
  // Formats that can only be written are no help.
  for (const extension of [".su2", ".inp", ".glb"]) expect(text).not.toContain(extension);
});

test("files that cannot be opened are named one by one, and the formats once", async () => {
  const files = ["notes.txt", "README", "table.csv"].map((name) => new File(["text"], name));
  const results = await readDroppedFiles(files, () => undefined);
  const lines = failureLines(results.flatMap((result) => (result.kind === "failed" ? [result] : [])));
  expect(lines.slice(0, 3).map((line) => line.split(":")[0])).toEqual(["notes.txt", "README", "table.csv"]);
  expect(lines.filter((line) => line.includes(".step"))).toHaveLength(1);
  expect(lines.slice(3).join()).toMatch(/^These can be opened:.*[.]vtu/);
});

test("a project is opened under any name, and what is wrong with it is said", async () => {
  const project = JSON.stringify(cubeProject());
  expect(await readDocumentFile(new File([project], "cube.txt"), () => undefined)).toMatchObject({
    kind: "opened",
  });
  const damaged = await readDocumentFile(new File([`${project.slice(0, 50)}`], "cube.txt"), () => undefined);
  expect(damaged).toMatchObject({ kind: "failed" });
  expect(damaged.kind === "failed" && failureLines([damaged]).join(" ")).not.toContain("can be opened");
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

import { expect, test } from "vitest";

import { readProjectFile } from "../../../web/document/files.js";

test("a file that cannot be read, such as a folder, is told and does not end in silence", async () => {
  const folder = Object.assign(new File([], "parts.json"), {
    text: () => Promise.reject(new Error("it is a folder")),
  });
  expect(await readProjectFile(folder)).toEqual({
    kind: "failed",
    fileName: "parts.json",
    reasons: ["Error: it is a folder"],
  });
});

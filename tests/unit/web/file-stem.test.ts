import { expect, test } from "vitest";

import { fileStem } from "../../../web/session/files.js";

test("the name of a project becomes the stem of file names", () => {
  expect(fileStem("Engine intake")).toBe("engine-intake");
  expect(fileStem(" ½ Öse & Haken! ")).toBe("½-öse-haken");
  expect(fileStem("…")).toBe("untitled");
});

test("with any extension, file names fit into the 255 bytes of file systems", () => {
  for (const letter of ["a", "ü", "語", "𠮷"]) {
    const stem = fileStem(letter.repeat(300));
    expect(stem).toBe(letter.repeat(60));
    expect(new TextEncoder().encode(`${stem}-report.json`).length).toBeLessThanOrEqual(255);
  }
  expect(fileStem("a ".repeat(200))).toMatch(/^(a-)+a$/);
});

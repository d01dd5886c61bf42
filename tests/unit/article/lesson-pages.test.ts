/** The lessons themselves, as they are built into the site. */
import path from "node:path";
import { describe, expect, test } from "vitest";
import {
  lessonEntries,
  lessonNumbers,
  makeLessonPage,
} from "../../../web/teach/article/compiler/lesson-site";

const folders = {
  root: path.resolve("web"),
  sources: path.resolve("web/lessons"),
  models: path.resolve("public/index.json"),
};
const numbers = lessonNumbers(folders.sources);
const pageOf = (number: number): string => makeLessonPage(`${number}/index.html`, folders) ?? "";

describe("the pages of the lessons", () => {
  test("are entries of the bundler, with their list", () => {
    const names = lessonEntries(folders).map((entry) => path.relative(folders.root, entry));
    const pages = [...numbers, "mesher"].map((page) => `lessons/${page}/index.html`);
    expect(names).toEqual(["lessons/index.html", ...pages]);
    const list = makeLessonPage("index.html", folders) ?? "";
    for (const number of numbers) expect(list).toContain(`href="./${number}/"`);
    expect(makeLessonPage("99/index.html", folders)).toBeNull();
  });

  test.each(numbers)("lesson %d has tasks, no style attributes, and links to its neighbours", (number) => {
    const page = pageOf(number);
    expect(page).toContain('data-testid="task-1"');
    expect(page).toContain('data-testid="figure-A"');
    expect(page).not.toMatch(/\sstyle=|\son[a-z]+=/);
    const index = numbers.indexOf(number);
    for (const neighbour of [numbers[index - 1], numbers[index + 1]])
      if (neighbour !== undefined) expect(page).toContain(`href="../${neighbour}/"`);
  });
});

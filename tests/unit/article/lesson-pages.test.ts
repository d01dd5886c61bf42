/** The lessons themselves, as they are built into the site. */
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { build } from "vite";
import { describe, expect, test } from "vitest";
import { compileLesson } from "../../../web/teach/article/compiler/compile-lesson";
import { declarations } from "../../../web/teach/article/declarations";
import {
  lessonEntries,
  lessonNumbers,
  lessonSite,
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

test("what the lessons say of the engine's speed is what the documents have measured", () => {
  const [crossing, order, finding] = [6, 7, 8].map((number) =>
    readFileSync(`web/lessons/${number}.md`, "utf8"),
  );
  const benchmarks = readFileSync("docs/BENCHMARKS.md", "utf8");
  const [, share = "", faces = "", analysed = ""] =
    /\| layered, filters on +\| +[\d ]+\| +([\d.]+) % \| +([\d.]+) \| +([\d.]+) \|/.exec(benchmarks) ?? [];
  const [, slowShare = ""] = /\| layered, filters off +\| +[\d ]+\| +([\d.]+) % \|/.exec(benchmarks) ?? [];
  expect(Math.round(Number(analysed))).toBe(1);
  expect(crossing).toContain(`compared with ${Number(faces).toFixed(0)} faces on average, and one of them`);
  expect(crossing).toContain(
    `takes ${Number(share).toFixed(0)} % of the time of the front, and ${Number(slowShare).toFixed(0)} %`,
  );
  const paper = readFileSync("docs/PAPER.md", "utf8");
  const rates = [
    ...paper.matchAll(
      /\| (?:tetrahedra per second, front, native|the same in the paper's order) +\| (\d+) (\d+) /g,
    ),
  ];
  expect(order).toContain(
    `makes ${rates[0]?.slice(1).join(",")} tetrahedra per second layer by layer, and ${rates[1]?.slice(1).join(",")} with`,
  );
  const near = [
    ...paper.matchAll(
      /\| (?:faces per crossing check|the same in the paper's order) +\| (\d+\.\d) +\| \d+\.\d +\| about/g,
    ),
  ];
  expect(order).toContain(
    `with ${near.map(([, count]) => Math.round(Number(count))).join(" faces instead of ")}.`,
  );
  expect(readFileSync("docs/DESIGN.md", "utf8")).toContain(
    "about ten look-ups instead of 8–14 dependent loads",
  );
  expect(finding).toContain("8 to 14 readings for a question");
});

test("the two examples of the documentation are lessons without mistakes", () => {
  const text = readFileSync("docs/LESSONS.md", "utf8");
  const section = text.slice(text.indexOf("### Two examples"), text.indexOf("### Errors"));
  const examples = [...section.matchAll(/^````\n([^]*?)^````$/gm)].map(([, source = ""]) => source);
  expect(examples).toHaveLength(2);
  for (const source of examples) {
    const { html } = compileLesson(source, "example.md", { declarations, lessons: [], models: [] });
    expect(html).toContain('data-testid="task-1"');
    expect(html).toContain('data-testid="figure-A"');
  }
});

test("every kind of figure is in the documentation, with all that the text may use", () => {
  const lines = readFileSync("docs/LESSONS.md", "utf8").split("\n");
  for (const kind of ["ball", "crossing-space", "front", "ideal"]) {
    const row = lines.find((line) => new RegExp(`^\\| \`${kind}\` `).test(line)) ?? "";
    const { values = {}, marks = {}, options = {} } = declarations[kind] ?? {};
    for (const name of [...Object.keys(marks), ...Object.keys(options)]) expect(row).toContain(`\`${name}\``);
    expect(Object.keys(values).filter((name) => !row.includes(`\`${name.replace(/\d$/, "")}`))).toEqual([]);
  }
});

test("a build with mistakes in a lesson tells each of them once", async () => {
  const sources = mkdtempSync(path.join(tmpdir(), "lessons-"));
  try {
    cpSync(folders.sources, sources, { recursive: true });
    writeFileSync(path.join(sources, "12.md"), "# Title\n\n> The lead.\n\n[1](A.size)\n\n[1](show:A.size)\n");
    const broken = { ...folders, sources };
    const built = build({
      configFile: false,
      logLevel: "silent",
      root: folders.root,
      plugins: [lessonSite(broken)],
      build: { write: false, rolldownOptions: { input: [...lessonEntries(broken)] } },
    });
    const message = await built.then(String, ({ message: text }: Error) => text);
    expect(message.match(/12\.md:5: "A\.size" is no address\./g)).toHaveLength(1);
    expect(message.match(/12\.md:7: There is no figure A\./g)).toHaveLength(1);
  } finally {
    rmSync(sources, { recursive: true });
  }
});

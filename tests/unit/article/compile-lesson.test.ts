/** The compiler of lessons: what it makes of the short syntax, and every mistake that it reports. */
import { describe, expect, test } from "vitest";
import { compileLesson, type LessonContext } from "../../../web/teach/article/compiler/compile-lesson";
import { spoken } from "../../../web/teach/article/compiler/formulas";
import { LessonError } from "../../../web/teach/article/compiler/lesson-error";
import type { FigureDeclaration } from "../../../web/teach/article/declaration";

const front: FigureDeclaration = {
  label: "A polygon",
  options: {
    size: { type: "number", label: "size" },
    shape: { type: "word", words: ["boot", "fish"] },
  },
  values: { triangles: "number", refused: "number", verdict: "text" },
  states: {
    step: { words: ["end", "middle"], takesNumber: true },
    pose: { words: ["even"], takesNumber: false },
  },
  marks: { front: "plain", refused: "refused" },
};
const context: LessonContext = { declarations: { front }, lessons: [1, 4], models: ["unit-cube"] };

const figure = "```figure front A\nsize: 0.12 in 0.06..0.26 by 0.01\n```\n";
const compile = (body: string, head = "# Title\n\n> The lead.\n\n") =>
  compileLesson(`${head}${figure}\n${body}`, "lessons/9.md", context);

/** The mistakes of a text whose first line is line 9 of the file. */
function mistakes(body: string, head?: string): string[] {
  try {
    compile(body, head);
  } catch (error) {
    if (error instanceof LessonError) return error.message.split("\n");
    throw error;
  }
  return [];
}

describe("a lesson is compiled", () => {
  test("with its title and lead", () => {
    const { title, summary, html } = compile("Text.");
    expect([title, summary]).toEqual(["Title", "The lead."]);
    expect(html).toContain('<h1>Title</h1>\n<p class="lead">The lead.</p>');
    expect(html).toContain("<p>Text.</p>");
  });

  test("with figures whose inputs have ranges", () => {
    const { html } = compile("");
    const plan = /data-figure="([^"]*)"/.exec(html)?.[1]?.replaceAll("&quot;", '"') ?? "";
    expect(JSON.parse(plan)).toEqual({
      id: "A",
      kind: "front",
      ranges: { size: { start: 0.12, min: 0.06, max: 0.26, step: 0.01, label: "size" } },
      words: {},
    });
    expect(html).toContain('id="figure-A" data-testid="figure-A"');
  });

  test("with numbers that are dragged, shown, and in formulas", () => {
    const { html, css } = compile(
      "[0.12](drag:A.size) and [71](show:A.triangles), $\\sqrt{\\live{A.size}{0.12}}$",
    );
    expect(html).toContain(
      'role="slider" tabindex="0" data-drag="A.size" data-unit="" data-testid="number-size"',
    );
    expect(html).toContain(
      'aria-valuemin="0.06" aria-valuemax="0.26" aria-valuenow="0.12" aria-valuetext="0.12"',
    );
    expect(html).toContain('<output class="live" data-show="A.triangles">71</output>');
    expect(html).toMatch(/data-show="A\.size"><span class="mord">0\.12<\/span>/);
    expect(html).toContain('aria-label="square root of ({A.size})"');
    expect(html).not.toContain("style=");
    expect(css).toMatch(/^\.f0\{/);
  });

  test("with formulas that are spoken in words", () => {
    expect(
      [
        "\\sqrt{h^2-\\live{A.size}{0.12}^2}",
        "\\tfrac12\\left(1+\\frac s{\\mathrm{size}}\\right)",
        "\\alpha^4=1-\\alpha^{1}-x_f",
        "\\mathbf{a}^{\\mathsf{T}}\\cdot\\mathrm{height}\\\\[4pt]\\xi''",
        "\\begin{pmatrix}\\live{A.xx}{1}&0\\\\\\live{A.xy}{2}&\\lambda\\end{pmatrix}",
      ].map(spoken),
    ).toEqual([
      "square root of (h squared - {A.size} squared)",
      "fraction 1 over 2, (1+ fraction s over size, )",
      "alpha 4 =1- alpha 1 -x f",
      "a transposed times height; xi double prime",
      "the matrix with the rows {A.xx}, 0; {A.xy}, lambda",
    ]);
  });

  test("with punctuation kept beside formulas", () => {
    const { html } = compile("The length $h$, and no more.");
    expect(html).toMatch(/<span class="after">,<\/span>(<\/span>){4} and no more\./);
    expect(html).not.toContain("<!--");
  });

  test("with words that lead to a state, light a part, and open the app", () => {
    const { html } = compile(
      "[the end](go:A step=end), [refused](mark:A.refused) and [a step](open:model=unit-cube step=99)",
    );
    expect(html).toContain('<span class="go" role="button" tabindex="0" data-go="A step=end">the end</span>');
    expect(html).toContain('data-role="refused" data-mark="A.refused">refused</span>');
    expect(html).toContain('<a class="open" href="../../?model=unit-cube&amp;step=99">a step</a>');
  });

  test("with tasks in their order", () => {
    const task = (ask: string) => `\`\`\`task\nask: ${ask}\nuntil: A.refused == 0\nbecause: So.\n\`\`\`\n`;
    const { html } = compile(task("One.") + task("Two."));
    expect(
      [...html.matchAll(/data-testid="(task-\d)" data-until="([^"]*)"/g)].map(([, ...found]) => found),
    ).toEqual([
      ["task-1", "A.refused == 0"],
      ["task-2", "A.refused == 0"],
    ]);
    expect(html).toContain('<p class="ask">Two.</p>');
  });

  test("with a text for each condition, the first of them visible", () => {
    const { html } = compile(
      "Now [[if A.size > 1: [0.2](show:A.size), $h$ | if A.size > 0.5: middling\n| small.]] Then.",
    );
    expect(html).toContain('<span data-choice><span data-if="A.size &gt; 1"><output class="live"');
    expect(html).toMatch(
      /<span data-if="A\.size &gt; 1">.*class="formula".*<\/span><span data-if="A\.size &gt; 0\.5" hidden>/,
    );
    expect(html).toContain('hidden>middling</span><span data-if="" hidden>small.</span></span> Then.');
  });

  test("with a walk", () => {
    const walk =
      "::: walk\n\n```figure front B\nsize: 0.2 in 0.1..0.3 by 0.1\n```\n\n::: stops\n@ B step=0\nFirst.\n\n@ B step=end\nLast.\n\nStill last.\n:::\n\nAfter.";
    const { html } = compile(walk);
    expect(html).toMatch(/<section class="walk"><figure [^>]*id="figure-B"/);
    expect(html).toContain('<div class="stop" data-go="B step=0"><p>First.</p>\n</div>');
    expect(html).toContain(
      'data-go="B step=end"><p>Last.</p>\n<p>Still last.</p>\n</div></div></section>\n<p>After.</p>',
    );
  });

  test("with a task in a stop of a walk", () => {
    const walk =
      "::: walk\n\n```figure front B\nsize: 0.2 in 0.1..0.3 by 0.1\n```\n\n::: stops\n@ B step=0\nFirst.\n\n```task\nask: Do it.\nuntil: B.refused == 0\nbecause: Done.\n```\n\nThen.\n\n@ B step=end\nLast.\n:::";
    const { html } = compile(walk);
    expect(html).toMatch(/data-go="B step=0"><p>First.<\/p>\s*<aside class="task"[^]*<\/aside><p>Then.<\/p>/);
    expect(html).toContain('<div class="stop" data-go="B step=end"><p>Last.</p>\n</div></div></section>');
  });

  test("without HTML of the author", () => {
    expect(compile("<b onclick=x>no</b>").html).toContain("&lt;b onclick=x&gt;no&lt;/b&gt;");
  });
});

describe("a mistake is reported with its line and a remedy", () => {
  test.each([
    ["unknown figure", "[1](show:B.size)", "lessons/9.md:9: There is no figure B. Use A."],
    [
      "unknown value",
      "A line.\nAnd [1](show:A.sise)",
      'lessons/9.md:10: The figure A has no value "sise". Use size, shape, triangles, refused or verdict.',
    ],
    [
      "number that cannot be dragged",
      "[1](drag:A.triangles)",
      'lessons/9.md:9: "A.triangles" cannot be dragged. Use A.size.',
    ],
    [
      "dragged word",
      "[small](drag:A.size)",
      'lessons/9.md:9: "small" is no number. Write a number, and its unit after it.',
    ],
    [
      "unknown step",
      "[x](go:A step=ends)",
      'lessons/9.md:9: "ends" is no step of the figure A. Use end, middle or a number.',
    ],
    ["number for a word", "[x](go:A pose=1)", 'lessons/9.md:9: "1" is no pose of the figure A. Use even.'],
    [
      "unknown state",
      "[x](go:A stop=1)",
      'lessons/9.md:9: The figure A has no state "stop". Use step or pose.',
    ],
    [
      "value in a condition of the text",
      "Text\n[[if A.h > 1: large | small]]",
      'lessons/9.md:10: The figure A has no value "h". Use size, shape, triangles, refused or verdict.',
    ],
    [
      "value in a text of a condition",
      "[[if A.size > 1: [1](show:A.h) | small]]",
      'lessons/9.md:9: The figure A has no value "h". Use size, shape, triangles, refused or verdict.',
    ],
    [
      "text for a condition, and none otherwise",
      "[[if A.size > 1: large]]",
      'lessons/9.md:9: A choice has a text for each condition, and a last text without one. Write it like "[[if A.size > 1: large | small]]".',
    ],
    [
      "condition of a text that compares a text",
      "[[if A.verdict == 1: large | small]]",
      'lessons/9.md:9: "A.verdict" is a text. Compare a number.',
    ],
    [
      "unreadable state",
      "[x](go:A end)",
      'lessons/9.md:9: "A end" names no state of a figure. Write it like "A step=0 beat=4".',
    ],
    [
      "unknown part",
      "[x](mark:A.side)",
      'lessons/9.md:9: The figure A has no part "side". Use front or refused.',
    ],
    [
      "unknown model",
      "[x](open:model=cube)",
      'lessons/9.md:9: There is no model "cube". Use an id of public/index.json.',
    ],
    [
      "unreadable step of a model",
      "[x](open:model=unit-cube step=a)",
      'lessons/9.md:9: "a" is no step. Write a whole number.',
    ],
    [
      "tie that does not say what it does",
      "Text\n[1](A.size)",
      'lessons/9.md:10: "A.size" is no address. Write what it does before it: drag:, show:, go:, mark: or open:.',
    ],
    [
      "picture",
      "Text\n![a picture](a.png)",
      'lessons/9.md:10: The picture "a.png" would not be in the site. Link to it, or use a figure.',
    ],
    [
      "lesson that is not written",
      "[x](../5/)",
      "lessons/9.md:9: There is no lesson 5 yet. Remove the link.",
    ],
    [
      "value in a formula",
      "$\\live{A.h}{1}$",
      'lessons/9.md:9: The figure A has no value "h". Use size, shape, triangles, refused or verdict.',
    ],
    [
      "unreadable formula",
      "Text\n\n$$\n\\frac{1}\n$$",
      /^lessons\/9\.md:11: The formula cannot be read: KaTeX parse error: .* Correct the LaTeX\.$/,
    ],
    [
      "unknown kind of figure",
      "```figure fronts B\n```",
      'lessons/9.md:9: There is no figure "fronts". Use front.',
    ],
    [
      "figure without a letter",
      "```figure front\n```",
      'lessons/9.md:9: "front" has no letter. Write "figure front A", with one capital letter.',
    ],
    [
      "two figures of one letter",
      figure,
      "lessons/9.md:9: There are two figures A. Give one of them another letter.",
    ],
    [
      "unknown option",
      "```figure front B\nsize: 1 in 0..2 by 1\nsice: 1\n```",
      'lessons/9.md:11: The figure "front" has no option "sice". Use size, shape or caption.',
    ],
    [
      "unknown tie",
      "Text [word](goto:A step=0)",
      'lessons/9.md:9: There is no tie "goto". Use drag, show, go, mark or open.',
    ],
    [
      "number that is not the start of its range",
      "Text [0.13](drag:A.size)",
      'lessons/9.md:9: "0.13" is not the start of A.size. Write 0.12, or change the start in the figure.',
    ],
    [
      "missing option",
      "```figure front B\n```",
      'lessons/9.md:9: The option "size" is missing. Add a line such as "size: 0.5 in 0..1 by 0.01".',
    ],
    [
      "start outside a range",
      "```figure front B\nsize: 3 in 0..2 by 1\n```",
      'lessons/9.md:10: "3 in 0..2 by 1" is no range. Write "size: START in MIN..MAX by STEP", with the start between both limits.',
    ],
    [
      "unknown word of an option",
      "```figure front B\nsize: 1 in 0..2 by 1\nshape: shoe\n```",
      'lessons/9.md:11: "shoe" is no shape. Use boot or fish.',
    ],
    [
      "line that is no field",
      "```task\nask: a\nuntil: 1 == 1\nbecause: b\n!\n```",
      'lessons/9.md:13: "!" is no field. Write "name: value".',
    ],
    [
      "task without a condition",
      "```task\nask: a\nbecause: b\n```",
      'lessons/9.md:9: The task has no "until". Add a line "until: …".',
    ],
    [
      "unknown field of a task",
      "```task\nask: a\nuntil: 1 == 1\nbecause: b\nhint: c\n```",
      'lessons/9.md:13: A task has no field "hint". Use ask, until and because.',
    ],
    [
      "unreadable condition",
      "```task\nask: a\nuntil: A.refused =\nbecause: b\n```",
      'lessons/9.md:11: The condition cannot be read: expected and, or, or the end, found "=". Write it like "A.touched and A.refused == 0".',
    ],
    [
      "value of a condition",
      "```task\nask: a\nuntil: A.reused == 0\nbecause: b\n```",
      'lessons/9.md:11: The figure A has no value "reused". Use size, shape, triangles, refused or verdict.',
    ],
    [
      "text in a condition",
      "```task\nask: a\nuntil: A.verdict == 0\nbecause: b\n```",
      'lessons/9.md:11: "A.verdict" is a text. Compare a number.',
    ],
    [
      "block without an end",
      "```task\nask: a\nuntil: 1 == 1\nbecause: b",
      'lessons/9.md:9: The block "task" does not end. Close it with a line ```.',
    ],
    [
      "walk without a figure",
      "::: walk\n::: stops\n:::",
      'lessons/9.md:9: The walk has no figure. Add a block ```figure before "::: stops".',
    ],
    [
      "text before the stops",
      `::: walk\nText\n\`\`\`figure front B\nsize: 1 in 0..2 by 1\n\`\`\`\n::: stops\n:::`,
      'lessons/9.md:10: A walk begins with its figure. Put the text after "::: stops".',
    ],
    [
      "walk without stops",
      `::: walk\n\`\`\`figure front B\nsize: 1 in 0..2 by 1\n\`\`\`\n:::`,
      'lessons/9.md:9: The walk has no stops. Add "::: stops" after the figure.',
    ],
    [
      "stop of an unknown figure",
      `::: walk\n\`\`\`figure front B\nsize: 1 in 0..2 by 1\n\`\`\`\n::: stops\n@ C step=0\nText\n:::`,
      "lessons/9.md:14: There is no figure C. Use A or B.",
    ],
    [
      "text without a stop",
      `::: walk\n\`\`\`figure front B\nsize: 1 in 0..2 by 1\n\`\`\`\n::: stops\nText\n:::`,
      'lessons/9.md:14: This text belongs to no stop. Begin the stop with a line such as "@ A step=0 beat=1".',
    ],
    [
      "walk without an end",
      `::: walk\n\`\`\`figure front B\nsize: 1 in 0..2 by 1\n\`\`\`\n::: stops\n@ B step=0\nText`,
      'lessons/9.md:9: The walk does not end. End it with a line ":::".',
    ],
    [
      "unknown division",
      "::: stroll",
      'lessons/9.md:9: "::: stroll" does not belong here. Begin a walk with "::: walk", end it with ":::".',
    ],
  ])("%s", (_name, body, expected) => {
    const found = mistakes(body);
    if (typeof expected === "string") expect(found).toContain(expected);
    else expect(found.some((line) => expected.test(line))).toBe(true);
  });

  test("missing title", () => {
    expect(mistakes("", "Text\n\n")).toContain(
      'lessons/9.md:1: The title is missing. Begin the file with a line "# Title".',
    );
  });

  test("missing lead", () => {
    expect(mistakes("", "# Title\n\n")).toEqual([
      'lessons/9.md:1: The lesson has no lead. Write one or two sentences below the title, after "> ".',
    ]);
  });

  test("one that stands twice in a line is reported once", () => {
    expect(mistakes("[1](show:B.x) [2](show:B.y)")).toEqual(["lessons/9.md:9: There is no figure B. Use A."]);
  });

  test("one in the head or a range of a figure is reported alone", () => {
    expect(
      mistakes(
        "```figure fronts B\n```\n[1](drag:B.size), [1](show:B.x), $\\live{B.y}{1}$, [x](go:B step=0)",
      ),
    ).toEqual(['lessons/9.md:9: There is no figure "fronts". Use front.']);
    expect(mistakes("```figure front B\nsize: 1 in 0-2\n```\n[1](drag:B.size)")).toEqual([
      expect.stringContaining('lessons/9.md:10: "1 in 0-2" is no range.'),
    ]);
    expect(
      mistakes("::: walk\n\n```figure front B\nsize: 1 in 0..2 by 1\n```\n\nText.\n\n@ B step=0\nText.\n:::"),
    ).toEqual(['lessons/9.md:9: The walk has no stops. Add "::: stops" after the figure.']);
  });

  test("text without figures has a remedy, too", () => {
    try {
      compileLesson("# Title\n\n> The lead.\n\n[1](show:A.x)", "lessons/9.md", context);
      expect.unreachable();
    } catch (error) {
      expect(String(error)).toContain(
        "lessons/9.md:5: There is no figure A. Add a block ```figure, with its kind and its letter.",
      );
    }
  });

  test("a file may begin with a byte order mark, and have lines of Windows", () => {
    const source = `# Title\n\n> The lead.\n\n${figure}\n[1](show:A.triangles)\n`;
    const { html } = compileLesson(source, "lessons/9.md", context);
    expect(compileLesson(`\uFEFF${source.replaceAll("\n", "\r\n")}`, "lessons/9.md", context).html).toBe(
      html,
    );
  });

  test("mistakes are in the order of their lines", () => {
    expect(
      mistakes("[1](show:A.x)\n\n```task\nask: a\nuntil: 1 == 1\nbecause: b\n!\n```").map((line) =>
        Number(line.split(":")[1]),
      ),
    ).toEqual([9, 15]);
  });

  test("all mistakes at once", () => {
    expect(mistakes("[1](show:A.x)\n\n[1](show:B.y)")).toHaveLength(2);
  });
});

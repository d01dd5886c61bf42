/**
 * Compiles a lesson, Markdown with figures and ties, to HTML (docs/LESSONS.md). It runs when the site is built, and finds the
 * mistakes that a reader would otherwise meet: figures, values, states and parts that do not exist.
 */
import { ConditionMismatch, parseCondition, valuesIn } from "../condition.ts";
import { readDestination, type FigureDeclaration } from "../declaration.ts";
import { planFigure, type Declarations, type PlannedFigure } from "./figure-plans.ts";
import { attribute, FormulaSheet, liveValuesIn, withPunctuation } from "./formulas.ts";
import {
  splitLesson,
  type FigureBlock,
  type LessonBlock,
  type TaskBlock,
  type TextBlock,
  type WalkBlock,
} from "./lesson-blocks.ts";
import { LessonError, listOf, type LessonMistake } from "./lesson-error.ts";
import { inlinesIn, makeMarkdown, tieKinds, type Branch, type Inline, type Tie } from "./lesson-markdown.ts";

export interface LessonContext {
  readonly declarations: Declarations;
  /** Numbers of the lessons that exist: others are not linked. */
  readonly lessons: readonly number[];
  /** Ids of the models that the app can open. */
  readonly models: readonly string[];
}

export interface CompiledLesson {
  readonly title: string;
  /** The lead without ties, for lists. */
  readonly summary: string;
  /** Everything within `main`. */
  readonly html: string;
  /** Styles of the formulas. */
  readonly css: string;
}

/** Compiles a lesson. Throws LessonError with all mistakes. `file` is its path for messages. */
export function compileLesson(source: string, file: string, context: LessonContext): CompiledLesson {
  return new Compiler(source, file, context).compile();
}

class Compiler {
  readonly #mistakes: LessonMistake[] = [];
  readonly #formulas = new FormulaSheet();
  readonly #figures = new Map<string, PlannedFigure>();
  /** Letters of figures whose kind is a mistake: what the text says of them cannot be checked. */
  readonly #unread = new Set<string>();
  readonly #markdown = makeMarkdown((inline) => this.#inlineHtml(inline));
  readonly #numbers = new Set<string>();
  #tasks = 0;

  constructor(
    readonly source: string,
    readonly file: string,
    readonly context: LessonContext,
  ) {}

  compile(): CompiledLesson {
    const { title, lead, blocks } = splitLesson(this.source, this.#note);
    if (!lead)
      this.#note(1, "The lesson has no lead.", 'Write one or two sentences below the title, after "> ".');
    for (const block of blocks) this.#plan(block);
    const html = [
      `<h1>${this.#inline(title)}</h1>`,
      lead ? `<p class="lead">${this.#inlineText(lead)}</p>` : "",
      ...blocks.map((block) => this.#blockHtml(block)),
    ];
    if (this.#mistakes.length > 0) throw new LessonError(this.#mistakes.toSorted((a, b) => a.line - b.line));
    const summary = (lead?.text ?? "").replaceAll(/\[([^\]]+)\]\([^)]*\)/g, "$1").replaceAll(/\s+/g, " ");
    return { title, summary, html: withPunctuation(html.join("\n")), css: this.#formulas.css };
  }

  readonly #note = (line: number, problem: string, remedy: string): void => {
    const isKnown = this.#mistakes.some((each) => each.line === line && each.problem === problem);
    if (isKnown) return;
    this.#mistakes.push({ file: this.file, line, problem, remedy });
  };

  /** Figures may be named before they appear. */
  #plan(block: LessonBlock): void {
    if (block.kind === "walk" && block.figure) this.#plan(block.figure);
    if (block.kind !== "figure") return;
    const planned = planFigure(block, this.context.declarations, this.#note);
    if (!planned) {
      this.#unread.add(letterOf(block));
      return;
    }
    if (this.#figures.has(planned.plan.id))
      this.#note(block.line, `There are two figures ${planned.plan.id}.`, "Give one of them another letter.");
    else this.#figures.set(planned.plan.id, planned);
  }

  #blockHtml(block: LessonBlock): string {
    switch (block.kind) {
      case "text":
        return this.#text(block);
      case "figure":
        return this.#figureHtml(block);
      case "task":
        return this.#taskHtml(block);
      case "walk":
        return this.#walkHtml(block);
    }
  }

  #text(block: TextBlock): string {
    this.#check(block);
    return this.#markdown.render(block.text);
  }

  #inlineText(block: TextBlock): string {
    this.#check(block);
    return this.#inline(block.text);
  }

  #inline(text: string): string {
    return this.#markdown.renderInline(text);
  }

  #figureHtml(block: FigureBlock): string {
    const id = letterOf(block);
    const figure = this.#figures.get(id);
    if (!figure) return "";
    const { plan, declaration, caption } = figure;
    const text = caption
      ? `<figcaption>${this.#inlineText({ kind: "text", line: caption.line, text: caption.value })}</figcaption>`
      : "";
    return `<figure class="figure ${plan.kind}" id="figure-${id}" data-testid="figure-${id}" data-figure="${attribute(JSON.stringify(plan))}"><div class="stage" role="group" aria-label="${attribute(declaration.label)}"></div>${text}</figure>`;
  }

  #taskHtml({ line, fields }: TaskBlock): string {
    const field = (name: string): TextBlock => {
      const found = fields.find((each) => each.name === name);
      if (!found) this.#note(line, `The task has no "${name}".`, `Add a line "${name}: …".`);
      return { kind: "text", line: found?.line ?? line, text: found?.value ?? "" };
    };
    for (const { name, line: at } of fields)
      if (!["ask", "until", "because"].includes(name))
        this.#note(at, `A task has no field "${name}".`, "Use ask, until and because.");
    const [ask, until, because] = [field("ask"), field("until"), field("because")];
    if (until.text !== "") this.#checkCondition(until);
    const number = ++this.#tasks;
    return `<aside class="task" data-testid="task-${number}" data-until="${attribute(until.text)}" aria-label="Task ${number}"><span class="tick" aria-hidden="true"></span><div><p class="ask">${this.#inlineText(ask)}</p><div class="because" role="status"><p hidden>${this.#inlineText(because)}</p></div></div></aside>`;
  }

  #walkHtml({ figure, stops }: WalkBlock): string {
    const html = stops.map(({ line, destination, parts }) => {
      this.#checkDestination(destination, line);
      const inner = parts.map((part) => this.#blockHtml(part)).join("");
      return `<div class="stop" data-go="${attribute(destination)}">${inner}</div>`;
    });
    return `<section class="walk">${figure ? this.#figureHtml(figure) : ""}<div class="stops">${html.join("")}</div></section>`;
  }

  #check(block: TextBlock): void {
    for (const { inline, line } of inlinesIn(this.#markdown, block.text)) {
      const at = block.line + line;
      if (inline.type === "tie") this.#checkTie(inline, at);
      else if (inline.type === "formula") this.#checkFormula(inline.tex, at);
      else if (inline.type === "choice") this.#checkChoice(inline.branches, at);
      else if (inline.type === "link") this.#checkLink(inline.address, at);
      else if (inline.type === "picture")
        this.#note(
          at,
          `The picture "${inline.address}" would not be in the site.`,
          "Link to it, or use a figure.",
        );
      else this.#note(at, `There is no tie "${inline.kind}".`, `Use ${listOf(tieKinds)}.`);
    }
  }

  #checkTie({ kind, label, target }: Tie, line: number): void {
    switch (kind) {
      case "drag":
        return this.#checkDrag(target, label, line);
      case "show":
        return void this.#valueOf(target, line);
      case "go":
        return this.#checkDestination(target, line);
      case "mark":
        return this.#checkMark(target, line);
      case "open":
        return this.#checkOpened(target, line);
    }
  }

  #figureOf(id: string, line: number): PlannedFigure | undefined {
    const figure = this.#figures.get(id);
    if (!figure && !this.#unread.has(id))
      this.#note(
        line,
        `There is no figure ${id === "" ? "without a letter" : id}.`,
        this.#figures.size > 0
          ? `Use ${listOf([...this.#figures.keys()])}.`
          : "Add a block ```figure, with its kind and its letter.",
      );
    return figure;
  }

  /** Returns the figure of a value such as `A.size`; notes a mistake if either does not exist. */
  #valueOf(target: string, line: number): FigureDeclaration | undefined {
    const [id = "", name = ""] = target.split(".");
    const declaration = this.#figureOf(id, line)?.declaration;
    const names = declaration && [...Object.keys(declaration.options), ...Object.keys(declaration.values)];
    if (names && !names.includes(name))
      this.#note(line, `The figure ${id} has no value "${name}".`, `Use ${listOf(names)}.`);
    return declaration;
  }

  #checkDrag(target: string, label: string, line: number): void {
    const [id = "", name = ""] = target.split(".");
    const figure = this.#figureOf(id, line);
    if (!figure) return;
    const numbers = Object.entries(figure.declaration.options).flatMap(([each, { type }]) =>
      type === "number" ? [each] : [],
    );
    // The range of a number that the figure has may be a mistake, noted before.
    const range = figure.plan.ranges[name];
    if (!numbers.includes(name))
      this.#note(
        line,
        `"${target}" cannot be dragged.`,
        numbers.length > 0
          ? `Use ${listOf(numbers.map((each) => `${id}.${each}`))}.`
          : "Show it by show: instead.",
      );
    const [text] = /^[-−]?[\d.]+/.exec(label) ?? [];
    if (text === undefined)
      this.#note(line, `"${label}" is no number.`, "Write a number, and its unit after it.");
    else if (range && Number(text.replace("−", "-")) !== range.start)
      this.#note(
        line,
        `"${label}" is not the start of ${target}.`,
        `Write ${range.start}, or change the start in the figure.`,
      );
  }

  #checkDestination(text: string, line: number): void {
    const destination = readDestination(text);
    if (!destination)
      return this.#note(line, `"${text}" names no state of a figure.`, 'Write it like "A step=0 beat=4".');
    const declaration = this.#figureOf(destination.figure, line)?.declaration;
    if (!declaration) return;
    for (const [key, value] of Object.entries(destination.entries)) {
      const state = Object.hasOwn(declaration.states, key) ? declaration.states[key] : undefined;
      const numbers = state?.takesNumber ? ["a number"] : [];
      if (!state)
        this.#note(
          line,
          `The figure ${destination.figure} has no state "${key}".`,
          `Use ${listOf(Object.keys(declaration.states))}.`,
        );
      else if (!state.words.includes(value) && !(state.takesNumber && Number.isFinite(Number(value))))
        this.#note(
          line,
          `"${value}" is no ${key} of the figure ${destination.figure}.`,
          `Use ${listOf([...state.words, ...numbers])}.`,
        );
    }
  }

  #checkMark(target: string, line: number): void {
    const [id = "", part = ""] = target.split(".");
    const marks = this.#figureOf(id, line)?.declaration.marks;
    if (marks && !Object.hasOwn(marks, part))
      this.#note(line, `The figure ${id} has no part "${part}".`, `Use ${listOf(Object.keys(marks))}.`);
  }

  #checkOpened(target: string, line: number): void {
    const query = new URLSearchParams(target.replaceAll(/\s+/g, "&"));
    const model = query.get("model") ?? "";
    if (!this.context.models.includes(model))
      this.#note(line, `There is no model "${model}".`, "Use an id of public/index.json.");
    const step = query.get("step");
    if (step !== null && !/^-?\d+$/.test(step))
      this.#note(line, `"${step}" is no step.`, "Write a whole number.");
  }

  #checkFormula(tex: string, line: number): void {
    for (const value of liveValuesIn(tex)) this.#valueOf(value, line);
    try {
      this.#formulas.render(tex, false);
    } catch (error) {
      this.#note(
        line,
        `The formula cannot be read: ${error instanceof Error ? error.message : ""}`,
        "Correct the LaTeX.",
      );
    }
  }

  #checkChoice(branches: readonly Branch[], line: number): void {
    branches.forEach(({ condition, text }, i) => {
      const isLast = i === branches.length - 1;
      if (condition !== "") this.#checkCondition({ kind: "text", text: condition, line });
      if ((condition === "") !== isLast || text === "")
        this.#note(
          line,
          "A choice has a text for each condition, and a last text without one.",
          'Write it like "[[if A.size > 1: large | small]]".',
        );
    });
  }

  #checkLink(address: string, line: number): void {
    if (/^[A-Z]([.\s]|$|%20)/.test(address))
      return this.#note(
        line,
        `"${decodeURI(address)}" is no address.`,
        `Write what it does before it: ${listOf(tieKinds.map((kind) => `${kind}:`))}.`,
      );
    const [, number] = /^\.\.\/(\d+)\/$/.exec(address) ?? [];
    if (number !== undefined && !this.context.lessons.includes(Number(number)))
      this.#note(line, `There is no lesson ${number} yet.`, "Remove the link.");
  }

  #checkCondition({ text, line }: TextBlock): void {
    try {
      for (const { figure, name } of valuesIn(parseCondition(text))) {
        const declaration = this.#valueOf(`${figure}.${name}`, line);
        const isText = declaration?.values[name] === "text" || declaration?.options[name]?.type === "word";
        if (isText) this.#note(line, `"${figure}.${name}" is a text.`, "Compare a number.");
      }
    } catch (error) {
      if (!(error instanceof ConditionMismatch)) throw error;
      this.#note(
        line,
        `The condition cannot be read: ${error.message}.`,
        'Write it like "A.touched and A.refused == 0".',
      );
    }
  }

  #inlineHtml(inline: Inline): string {
    if (inline.type === "formula") {
      try {
        return this.#formulas.render(inline.tex, inline.isDisplayed);
      } catch {
        // Its mistake has been noted.
        return "";
      }
    }
    if (inline.type === "choice") return this.#choiceHtml(inline.branches);
    return inline.type === "tie" ? this.#tieHtml(inline) : "";
  }

  /** The first text is what a reader sees before the figure has computed its values. */
  #choiceHtml(branches: readonly Branch[]): string {
    const texts = branches.map(
      ({ condition, text }, i) =>
        `<span data-if="${attribute(condition)}"${i > 0 ? " hidden" : ""}>${this.#inline(text)}</span>`,
    );
    return `<span data-choice>${texts.join("")}</span>`;
  }

  #tieHtml({ kind, label, target }: Tie): string {
    const text = this.#inline(label);
    const to = attribute(target);
    switch (kind) {
      case "drag":
        return this.#dragHtml(label, target);
      case "show":
        return `<output class="live" data-show="${to}">${text}</output>`;
      case "go":
        return `<span class="go" role="button" tabindex="0" data-go="${to}">${text}</span>`;
      case "mark": {
        const [id = "", part = ""] = target.split(".");
        const role = this.#figures.get(id)?.declaration.marks[part] ?? "plain";
        return `<span class="mark" role="button" tabindex="0" aria-pressed="false" data-role="${role}" data-mark="${to}">${text}</span>`;
      }
      case "open":
        return `<a class="open" href="../../?${attribute(target.replaceAll(/\s+/g, "&"))}">${text}</a>`;
    }
  }

  #dragHtml(label: string, target: string): string {
    const [id = "", name = ""] = target.split(".");
    const range = this.#figures.get(id)?.plan.ranges[name];
    const unit = label.replace(/^[-−]?[\d.]+/, "");
    if (!range) return "";
    // The first number of a name has the plain test id.
    const first = `number-${name}`;
    const owner = [...this.#numbers].find((each) => each.endsWith(`.${name}`));
    const testId = owner === undefined || owner === target ? first : `${first}-${id}`;
    const isAgain = this.#numbers.has(target);
    this.#numbers.add(target);
    return `<span class="drag" role="slider" tabindex="0" data-drag="${attribute(target)}" data-unit="${attribute(unit)}"${isAgain ? "" : ` data-testid="${testId}"`} aria-label="${attribute(range.label)}" aria-valuemin="${range.min}" aria-valuemax="${range.max}" aria-valuenow="${range.start}" aria-valuetext="${attribute(label)}">${attribute(label)}</span>`;
  }
}

/** Returns the letter of a figure, the second word of its head. */
function letterOf({ head }: FigureBlock): string {
  return head.split(/\s+/)[1] ?? "";
}

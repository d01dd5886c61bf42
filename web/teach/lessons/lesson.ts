/**
 * A lesson: markdown with a head in YAML, which names the model, the state of its front, and the tasks
 * (docs/LESSONS.md). Files come from teachers, so every error names the file, the field and what to do.
 */
import { FRONT_ORDERS } from "tetrafront";
import * as v from "valibot";
import { parse as parseYaml, YAMLParseError } from "yaml";
import { stopKinds } from "../player/stops";

/** What the front's colours may show. */
const colorings = ["age", "size", "layer"] as const;
/** Figures that a lesson may show. */
export const figures = ["queue", "search-cost"] as const;
/** Where a task may send the reader: a step of a kind, or the last state. */
const targets = [...stopKinds, "end"] as const;

const text = v.pipe(
  v.string("must be a text; put it in quotes"),
  v.trim(),
  v.nonEmpty("is empty; write a text"),
);
const number = v.pipe(v.number("must be a number without a unit"), v.finite("must be a finite number"));
const oneOf = <const Names extends readonly string[]>(names: Names) =>
  v.picklist(names, `must be one of: ${names.join(", ")}`);

const common = {
  ask: text,
  /** What to try after a wrong answer. */
  hint: v.optional(text),
  /** What the answer means, shown once it is right. */
  because: v.optional(text),
};

const stepTask = v.strictObject({ kind: v.literal("step"), ...common, reach: oneOf(targets) });
const colorTask = v.strictObject({ kind: v.literal("color"), ...common, coloring: oneOf(colorings) });
const numberTask = v.strictObject({
  kind: v.literal("number"),
  ...common,
  answer: number,
  /** Largest permitted difference from the answer; 0 if it is left out. */
  tolerance: v.optional(v.pipe(number, v.minValue(0, "must not be negative")), 0),
});
const choiceTask = v.pipe(
  v.strictObject({
    kind: v.literal("choice"),
    ...common,
    choices: v.pipe(
      v.array(text, "must be a list of texts"),
      v.minLength(2, "needs at least two texts"),
      v.checkItems((choice, i, all) => all.indexOf(choice) === i, "is in the list twice; remove one"),
    ),
    answer: text,
  }),
  v.forward(
    v.partialCheck(
      [["choices"], ["answer"]],
      ({ choices, answer }) => choices.includes(answer),
      "is not one of the choices; copy one of them",
    ),
    ["answer"],
  ),
);
const compareTask = v.strictObject({ kind: v.literal("compare"), ...common, order: oneOf(FRONT_ORDERS) });

const task = v.variant(
  "kind",
  [stepTask, colorTask, numberTask, choiceTask, compareTask],
  "must be one of: step, color, number, choice, compare",
);

const head = v.strictObject({
  title: text,
  /** Id of a model of the gallery, or the name of a project file beside the lesson. */
  model: text,
  order: v.optional(oneOf(FRONT_ORDERS), "layered"),
  /** Negative in the states of lines and patches, as in the player. */
  step: v.optional(v.pipe(number, v.integer("must be a whole number")), 0),
  coloring: v.optional(oneOf(colorings), "age"),
  /** One or several. */
  figure: v.optional(
    v.pipe(
      v.union(
        [v.picklist(figures), v.array(v.picklist(figures))],
        `must be one of: ${figures.join(", ")}, or a list of them`,
      ),
      v.transform((shown) => (typeof shown === "string" ? [shown] : shown)),
    ),
    [],
  ),
  /** Section of the paper. */
  paper: text,
  tasks: v.pipe(v.array(task, "must be a list of tasks"), v.minLength(1, "needs at least one task")),
});

export type LessonTask = v.InferOutput<typeof task>;
export type TaskOf<Kind extends LessonTask["kind"]> = Extract<LessonTask, { readonly kind: Kind }>;

export interface Lesson extends v.InferOutput<typeof head> {
  /** Name of its file without the extension; progress is kept under it. */
  readonly id: string;
  /** The text in markdown, with formulas between dollar signs. */
  readonly text: string;
}

export type ParsedLesson =
  | { readonly success: true; readonly lesson: Lesson }
  | { readonly success: false; readonly errors: readonly string[] };

const fence = /^---[ \t]*\r?\n([\s\S]*?)\r?\n---[ \t]*(?:\r?\n|$)/;

/** Reads a lesson. Each error begins with the name of the file and names the field or line. */
export function parseLesson(file: string, content: string): ParsedLesson {
  const fail = (...errors: readonly string[]): ParsedLesson => ({
    success: false,
    errors: errors.map((error) => `${file}: ${error}`),
  });
  const found = fence.exec(content.replace(/^\uFEFF/, ""));
  if (!found)
    return fail('the head is missing; begin the file with a line "---", the fields, and another "---".');
  const [whole, yaml = ""] = found;
  let fields: unknown;
  try {
    fields = parseYaml(yaml);
  } catch (error) {
    if (!(error instanceof YAMLParseError)) throw error;
    // The fence is the first line of the file.
    const line = (error.linePos?.[0].line ?? 0) + 1;
    const [reason = ""] = error.message.split(" at line");
    return fail(`line ${line} of the head is not YAML: ${reason}. Put texts with a colon in quotes.`);
  }
  const read = v.safeParse(head, fields ?? {});
  if (!read.success) return fail(...read.issues.map(sentenceOf));
  const body = content.slice(content.indexOf(whole) + whole.length).trim();
  if (body === "") return fail("there is no text after the head; write the lesson there.");
  return { success: true, lesson: { ...read.output, id: file.replace(/\.md$/, ""), text: body } };
}

/** Returns what is wrong with a field, and what to do. */
function sentenceOf(issue: v.BaseIssue<unknown>): string {
  const path = v.getDotPath(issue);
  if (path === null) return "the head has no fields; write `title: …` and the others, one per line.";
  if (issue.type === "strict_object" && issue.expected === "never")
    return `field "${path}" is unknown; correct its name or remove it.`;
  if (issue.received === "undefined") return `field "${path}" is missing; add it.`;
  return `field "${path}" ${issue.message}.`;
}

/** Reads the blocks `figure` of a lesson: which instrument, which letter, and where its inputs begin. */
import type { FigureDeclaration, FigurePlan, Range } from "../declaration.ts";
import type { Field, FigureBlock } from "./lesson-blocks.ts";
import { listOf, type NoteMistake } from "./lesson-error.ts";

export type Declarations = Readonly<Record<string, FigureDeclaration>>;

export interface PlannedFigure {
  readonly plan: FigurePlan;
  readonly declaration: FigureDeclaration;
  readonly caption: Field | null;
}

const rangePattern = /^(-?[\d.]+) in (-?[\d.]+)\.\.(-?[\d.]+) by ([\d.]+)$/;

/** Returns the figure of a block; null if its kind or letter cannot be read. */
export function planFigure(
  block: FigureBlock,
  declarations: Declarations,
  note: NoteMistake,
): PlannedFigure | null {
  const [kind = "", id = "", ...more] = block.head.split(/\s+/);
  const declaration = Object.hasOwn(declarations, kind) ? declarations[kind] : undefined;
  if (!declaration) {
    note(block.line, `There is no figure "${kind}".`, `Use ${listOf(Object.keys(declarations))}.`);
    return null;
  }
  if (!/^[A-Z]$/.test(id) || more.length > 0) {
    note(block.line, `"${block.head}" has no letter.`, `Write "figure ${kind} A", with one capital letter.`);
    return null;
  }
  const ranges: Record<string, Range> = {};
  const words: Record<string, string> = {};
  for (const field of block.fields) {
    const option = Object.hasOwn(declaration.options, field.name)
      ? declaration.options[field.name]
      : undefined;
    if (field.name === "caption") continue;
    if (!option)
      note(
        field.line,
        `The figure "${kind}" has no option "${field.name}".`,
        `Use ${listOf([...Object.keys(declaration.options), "caption"])}.`,
      );
    else if (option.type === "number") {
      const range = readRange(field, option.label, note);
      if (range) ranges[field.name] = range;
    } else if (option.words.includes(field.value)) words[field.name] = field.value;
    else note(field.line, `"${field.value}" is no ${field.name}.`, `Use ${listOf(option.words)}.`);
  }
  for (const [name, option] of Object.entries(declaration.options)) {
    const isMissing = option.type === "number" && !block.fields.some((field) => field.name === name);
    if (isMissing)
      note(
        block.line,
        `The option "${name}" is missing.`,
        `Add a line such as "${name}: 0.5 in 0..1 by 0.01".`,
      );
  }
  const caption = block.fields.find(({ name }) => name === "caption") ?? null;
  return { plan: { id, kind, ranges, words }, declaration, caption };
}

function readRange({ name, value, line }: Field, label: string, note: NoteMistake): Range | null {
  const numbers = rangePattern.exec(value)?.slice(1).map(Number);
  const [start = NaN, min = NaN, max = NaN, step = NaN] = numbers ?? [];
  if (min <= start && start <= max && step > 0 && step <= max - min) return { start, min, max, step, label };
  note(
    line,
    `"${value}" is no range.`,
    `Write "${name}: START in MIN..MAX by STEP", with the start between both limits.`,
  );
  return null;
}

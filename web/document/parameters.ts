import { LIMITS } from "tetrafront";
import type { Project, ProjectExpression } from "tetrafront/project";
import {
  isReservedName,
  type NamedNumbers,
  namesIn,
  readNumber,
  unknownNameIn,
  withNameReplaced,
} from "../expressions/expression";
import { dependentParameters } from "../expressions/parameters";
import { projectNumbers } from "./length-units";
import { parameterProblems, stepNames } from "../strings";
import type { ProjectDraft } from "./draft-records";
import type { ProjectEdit } from "./edit";

/** The parameters of a project: named numbers that expressions use. */

const namePattern = /^[A-Za-z_][A-Za-z0-9_]*$/;

/** Returns why a parameter cannot have a name; null if it can. `own` is the name that it has now. */
export function nameProblem({ parameters = [] }: Project, name: string, own?: string): string | null {
  if (!namePattern.test(name)) return parameterProblems.name;
  if (isReservedName(name)) return parameterProblems.reserved(name);
  const isTaken = name !== own && parameters.some((parameter) => parameter.name === name);
  return isTaken ? parameterProblems.taken(name) : null;
}

/** Returns why a parameter cannot be renamed; null if it can. */
export function renameProblem(project: Project, name: string, next: string): string | null {
  const { parameters = [], expressions = [] } = project;
  const isTooLong = [...parameters, ...expressions].some(
    ({ expression }) => lengthWith(expression, name, next) > LIMITS.expression,
  );
  return nameProblem(project, next, name) ?? (isTooLong ? parameterProblems.longer(next) : null);
}

/** Returns why a parameter cannot have an expression; null if it can. */
export function expressionProblem(project: Project, name: string, expression: string): string | null {
  const { parameters = [] } = project;
  const dependents = dependentParameters(parameters, name);
  if ([...namesIn(expression)].some((used) => dependents.has(used))) return parameterProblems.cycle(name);
  const named = projectNumbers(project);
  if (readNumber(expression, named) !== null) return null;
  const unknown = unknownNameIn(expression, named);
  return unknown === undefined ? parameterProblems.expression : parameterProblems.unknown(unknown);
}

/** Returns a name that no parameter has: `p1`, `p2` and so on. */
export function freeName({ parameters = [] }: Project): string {
  const names = new Set(parameters.map(({ name }) => name));
  let count = 1;
  while (names.has(`p${count}`)) ++count;
  return `p${count}`;
}

const withoutSpaces = (text: string): string => text.trim();

export function addParameter(name: string, expression: string): ProjectEdit {
  return {
    label: stepNames.addParameter(name),
    change: ({ project }) => {
      (project.parameters ??= []).push({ name, expression: withoutSpaces(expression) });
    },
  };
}

export function setParameter(name: string, expression: string): ProjectEdit {
  return {
    label: stepNames.setParameter(name),
    change: ({ project }) => {
      const parameter = project.parameters?.find((one) => one.name === name);
      if (parameter) parameter.expression = withoutSpaces(expression);
    },
  };
}

/** Renames a parameter, also in all expressions. */
export function renameParameter(name: string, next: string): ProjectEdit {
  return {
    label: stepNames.renameParameter(name),
    change: ({ project }) => {
      const values = projectNumbers({ units: project.units, parameters: [...(project.parameters ?? [])] });
      const parameter = project.parameters?.find((one) => one.name === name);
      if (parameter) parameter.name = next;
      replaceName(project, name, next, values);
    },
  };
}

/** Removes a parameter. Expressions that use it get its value, so that the model stays as it is. */
export function removeParameter(project: Project, name: string): ProjectEdit {
  const values = projectNumbers(project);
  const value = values.get(name);
  return {
    label: stepNames.removeParameter(name),
    change: ({ project: draft }) => {
      const rest = (draft.parameters ?? []).filter((one) => one.name !== name);
      if (rest.length > 0) draft.parameters = rest;
      else delete draft.parameters;
      if (value !== undefined) replaceName(draft, name, value < 0 ? `(${value})` : String(value), values);
    },
  };
}

/**
 * Replaces a name in all expressions. One that would become too long for the file gives way to its value; one that has no
 * value stays as it is. `values`: those before.
 */
function replaceName(draft: ProjectDraft, name: string, text: string, values: NamedNumbers): void {
  const { parameters = [], expressions = [] } = draft;
  const fits = (expression: string): boolean => lengthWith(expression, name, text) <= LIMITS.expression;
  for (const parameter of parameters) {
    const { expression } = parameter;
    const value = values.get(parameter.name);
    if (fits(expression)) parameter.expression = withNameReplaced(expression, name, text);
    else if (value !== undefined) parameter.expression = String(value);
  }
  const kept = expressions.filter(({ expression }) => fits(expression));
  for (const noted of kept) noted.expression = withNameReplaced(noted.expression, name, text);
  if (kept.length === expressions.length) return;
  if (kept.length > 0) draft.expressions = kept;
  else delete draft.expressions;
}

/** Returns the length of an expression after the replacement of a name. */
const lengthWith = (expression: string, name: string, text: string): number =>
  withNameReplaced(expression, name, text).length;

/** Returns the expressions that use a parameter, directly or through other parameters. */
export function usesOf({ parameters = [], expressions = [] }: Project, name: string): ProjectExpression[] {
  const names = dependentParameters(parameters, name);
  return expressions.filter(({ expression }) => [...namesIn(expression)].some((used) => names.has(used)));
}

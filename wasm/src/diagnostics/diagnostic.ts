/** Diagnostics: one problem each, with its entities, its location and what to do about it. */
import type { EntityKind, Severity } from "../generated/constants.js";
import type { DiagnosticCode } from "./codes.js";
import type { DiagnosticData } from "./data.js";

/** Entity that a diagnostic refers to. `id` is its id in the project, if it has one. */
export interface EntityRef {
  readonly kind: EntityKind;
  /** Index in the array of that kind. */
  readonly index: number;
  readonly id?: number | undefined;
  /** Name given by the user, or for example "line 12". */
  readonly label: string;
}

/** Diagnostic of one code. */
export interface DiagnosticOf<Code extends DiagnosticCode> {
  /** Stable machine name, e.g. `open-edge`. */
  readonly code: Code;
  readonly severity: Severity;
  /** One sentence: what is wrong, with the entities and the position. */
  readonly message: string;
  /** One sentence: what to do about it. Empty if nothing needs to be done. */
  readonly remedy: string;
  readonly entities: readonly EntityRef[];
  readonly position?: readonly [number, number, number] | undefined;
  /** Id of the body that it is about; the indices of its triangles and nodes are those of the body. */
  readonly body?: number | undefined;
  /** Numbers of the message, by name. */
  readonly data: DiagnosticData[Code];
}

/**
 * One problem, or information: what, where, and what to do. The `code` determines the type of the `data`.
 *
 *     if (found.code === "too-many-elements") retry(Math.cbrt(found.data.expected / found.data.limit));
 */
export type Diagnostic = { [Code in DiagnosticCode]: DiagnosticOf<Code> }[DiagnosticCode];

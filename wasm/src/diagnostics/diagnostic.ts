/** Diagnostics: one problem each, with its entities, its location and what to do about it. */
import type { DiagnosticCode } from "./codes.js";
import type { DiagnosticData } from "./data.js";

/** What a diagnostic can be about. */
export type EntityKind =
  | "point"
  | "line"
  | "patch"
  | "background-node"
  | "background-tetrahedron"
  | "triangle"
  | "surface-node"
  | "source";

/** What a diagnostic is about. `id` is the project's id where the entity has one. */
export interface EntityRef {
  readonly kind: EntityKind;
  /** Position in the array of that kind. */
  readonly index: number;
  readonly id?: number | undefined;
  /** What the user called it, else e.g. "line 12". */
  readonly label: string;
}

/** Only errors keep a model from being meshed. */
export type Severity = "information" | "warning" | "error";

/** A diagnostic of one code. */
export interface DiagnosticOf<Code extends DiagnosticCode> {
  /** Stable machine name, e.g. `open-edge`. */
  readonly code: Code;
  readonly severity: Severity;
  /** One sentence: what is wrong, naming the entities and the place. */
  readonly message: string;
  /** One sentence: what to do about it. Empty for information that asks for nothing. */
  readonly remedy: string;
  readonly entities: readonly EntityRef[];
  readonly position?: readonly [number, number, number] | undefined;
  /** The numbers of the sentence, by their names. */
  readonly data: DiagnosticData[Code];
}

/**
 * One thing that is wrong, or worth knowing: what, where, and what to do. Its `code` tells of what type its `data` are.
 *
 *     if (found.code === "too-many-elements") retry(Math.cbrt(found.data.expected / found.data.limit));
 */
export type Diagnostic = { [Code in DiagnosticCode]: DiagnosticOf<Code> }[DiagnosticCode];

import type { Diagnostic, EntityRef, Project } from "tetrafront";
import { entityKey, recordsOf, type DrawnKind, type Entity } from "./entities";

/** Something wrong with the project or its mesh, tied to what the user can select. */
export interface Problem {
  /** Stable while the problem stays the same. */
  readonly key: string;
  readonly severity: "warning" | "error";
  readonly code: string;
  readonly message: string;
  readonly remedy: string;
  readonly entities: readonly Entity[];
  readonly place: readonly [number, number, number] | null;
}

function isDrawn(kind: EntityRef["kind"]): kind is DrawnKind {
  return kind === "point" || kind === "line" || kind === "patch" || kind === "background-node";
}

function toEntity(project: Project, ref: EntityRef): Entity | null {
  if (!isDrawn(ref.kind)) return null;
  const id = ref.id ?? recordsOf(project, ref.kind)[ref.index]?.id;
  return id === undefined ? null : { kind: ref.kind, id };
}

/**
 * Diagnostics of check and run as problems: without repetition, errors first, else in order. What is
 * for information only is in the log and asks nothing of the user.
 */
export function toProblems(project: Project, diagnostics: readonly Diagnostic[]): Problem[] {
  const problems = new Map<string, Problem>();
  for (const { code, severity, message, remedy, entities, place } of diagnostics) {
    const key = `${code}: ${message}`;
    if (severity === "information" || problems.has(key)) continue;
    problems.set(key, {
      key,
      severity,
      code,
      message,
      remedy,
      entities: entities.map((ref) => toEntity(project, ref)).filter((entity) => entity !== null),
      place: place ?? null,
    });
  }
  const rank = { error: 0, warning: 1 };
  return [...problems.values()].sort((a, b) => rank[a.severity] - rank[b.severity]);
}

/** The problems of each entity, by entity key. */
export function problemsByEntity(problems: readonly Problem[]): ReadonlyMap<string, readonly Problem[]> {
  const byEntity = new Map<string, Problem[]>();
  for (const problem of problems) {
    for (const entity of problem.entities) {
      const key = entityKey(entity);
      byEntity.set(key, [...(byEntity.get(key) ?? []), problem]);
    }
  }
  return byEntity;
}

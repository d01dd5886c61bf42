/** Describes diagnostics of the engine: unpacks their arrays, names the entities, and fills in the sentences. */
import { positionText } from "../base/position-text.js";
import { PAUSE, type Steps } from "../base/steps.js";
import {
  CHECKED_OPTIONS,
  type DiagnosticArrays,
  ENGINE_VALUES,
  type EngineCode,
  ENTITY_KINDS,
  type EntityKind,
  SEVERITIES,
  type ValueType,
} from "../generated/constants.js";
import { engineCodeName } from "./codes.js";
import type { DiagnosticData } from "./data.js";
import type { Diagnostic, DiagnosticOf, EntityRef } from "./diagnostic.js";
import type { EntityNamer } from "./entity-names.js";
import { sentence } from "./package-diagnostic.js";
import { SENTENCES, type Subject } from "./sentences.js";

/** Diagnostic as the engine returns it. */
export interface EngineDiagnostic {
  readonly code: number;
  /** Index in `SEVERITIES`. */
  readonly severity: number;
  /** The most relevant first. */
  readonly entities: readonly EngineEntity[];
  readonly position: readonly [number, number, number] | undefined;
  readonly values: Float64Array;
}

/** `kind`: index in `ENTITY_KINDS`. */
export interface EngineEntity {
  readonly kind: number;
  readonly index: number;
}

/** Yields the diagnostics of the engine one by one. */
export function* unpacked(arrays: DiagnosticArrays): Generator<EngineDiagnostic> {
  const { code: codes, severity, entities, hasPosition, position, values } = arrays;
  let [entity, value] = [0, 0];
  for (const [i, code] of codes.entries()) {
    const kinds = entities.items.kind.subarray(entity, (entity += entities.lengths[i] ?? 0));
    const first = entity - kinds.length;
    const [x = 0, y = 0, z = 0] = position.subarray(3 * i, 3 * i + 3);
    yield {
      code,
      severity: severity[i] ?? 0,
      entities: Array.from(kinds, (kind, k) => ({ kind, index: entities.items.index[first + k] ?? 0 })),
      position: hasPosition[i] === 1 ? [x, y, z] : undefined,
      values: values.items.subarray(value, (value += values.lengths[i] ?? 0)),
    };
  }
}

/** Describes all diagnostics of the engine. */
export function describeAll(arrays: DiagnosticArrays, name: EntityNamer): Diagnostic[] {
  return Array.from(unpacked(arrays), (raw) => describeDiagnostic(raw, name));
}

/** Number of sentences per slice, at about ten microseconds each. */
export const SENTENCES_PER_SLICE = 256;

/** Describes all diagnostics in slices: a badly damaged surface may have a million. */
export function* describeInSteps(arrays: DiagnosticArrays, name: EntityNamer): Steps<Diagnostic[]> {
  const described: Diagnostic[] = [];
  for (const raw of unpacked(arrays)) {
    described.push(describeDiagnostic(raw, name));
    if (described.length % SENTENCES_PER_SLICE === 0) yield PAUSE;
  }
  return described;
}

/** Describes one diagnostic of the engine. */
export function describeDiagnostic(raw: EngineDiagnostic, name: EntityNamer): Diagnostic {
  const code = engineCodeName(raw.code);
  if (code === undefined) throw new Error(`the engine returned the unknown diagnostic code ${raw.code}`);
  // The compiler cannot infer the union over all codes from the type for one code.
  return describedAs(code, raw, name) as Diagnostic;
}

export function describedAs<Code extends EngineCode>(
  code: Code,
  raw: EngineDiagnostic,
  name: EntityNamer,
): DiagnosticOf<Code> {
  return withSentences({
    code,
    severity: SEVERITIES[raw.severity] ?? "error",
    entities: namedEntities(raw.entities, name),
    ...(raw.position && { position: raw.position }),
    data: dataOf(code, raw.values),
  });
}

/** Returns a diagnostic with the sentences that follow from the rest of it. */
export function withSentences<Code extends EngineCode>(
  found: Omit<DiagnosticOf<Code>, "message" | "remedy">,
): DiagnosticOf<Code> {
  const { code, entities, data } = found;
  const subject = subjectOf<Code>(found, entities, data);
  const { message, remedy } = SENTENCES[code];
  return {
    ...found,
    message: sentence(withCounting(message(subject), entities)),
    remedy: typeof remedy === "string" ? remedy : remedy(subject),
  };
}

/** Returns the engine's values by name. Throws if one is missing. */
export function dataOf<Code extends EngineCode>(code: Code, values: Float64Array): DiagnosticData[Code] {
  const data: Record<string, unknown> = {};
  for (const [i, { name, type, isOptional }] of ENGINE_VALUES[code].entries()) {
    const value = values[i];
    if (value !== undefined) data[name] = READ[type](value);
    else if (!isOptional) throw new Error(`the engine returned no ${name} with ${code}`);
  }
  // The type is generated from the same table as `ENGINE_VALUES`.
  return data as DiagnosticData[Code];
}

const READ: { readonly [Type in ValueType]: (value: number) => unknown } = {
  number: (value) => value,
  flag: (value) => value === 1,
  option: (value) => CHECKED_OPTIONS[value],
};

/** Adds "(counted from 0)" after the first label that has an index. */
export function withCounting(message: string, entities: readonly EntityRef[]): string {
  const ends = entities
    .filter(({ id }) => id === undefined)
    .flatMap(({ label }) => {
      let at = message.indexOf(label);
      // "triangle 1" also begins "triangle 12".
      while (at >= 0 && /\d/.test(message.charAt(at + label.length))) at = message.indexOf(label, at + 1);
      return at < 0 ? [] : [at + label.length];
    });
  if (ends.length === 0) return message;
  const end = Math.min(...ends);
  return `${message.slice(0, end)} (counted from 0)${message.slice(end)}`;
}

export function namedEntities(entities: readonly EngineEntity[], name: EntityNamer): EntityRef[] {
  return entities.flatMap(({ kind, index }) => {
    const kindName = ENTITY_KINDS[kind];
    return kindName === undefined ? [] : [name(kindName, index)];
  });
}

export function subjectOf<Code extends EngineCode>(
  { position }: Pick<DiagnosticOf<Code>, "position">,
  entities: readonly EntityRef[],
  data: DiagnosticData[Code],
): Subject<Code> {
  const drawn = entities.some(({ kind }) => kind === "line" || kind === "patch" || kind === "point");
  // Messages about a drawing name lines and patches, not the triangles that they have.
  const isNamed = (kind: EntityKind) => !drawn || kind !== "triangle";
  const labels = (kinds: readonly EntityKind[]) =>
    entities.filter(({ kind }) => kinds.includes(kind) && isNamed(kind)).map(({ label }) => label);
  return {
    data,
    the: (kind) => labels([kind])[0] ?? `a ${kind.replace("-", " ")}`,
    count: (kinds) => new Set(labels(kinds)).size,
    all: (kinds, otherwise) => joined([...new Set(labels(kinds))]) ?? otherwise,
    at: position === undefined ? "" : ` at ${positionText(position)}`,
    main: entities[0]?.label ?? "the model",
    kind: entities[0]?.kind,
    drawn,
  };
}

/** Largest number of names in a message; if there are more, the rest is counted. */
export const MAX_NAMES = 8;

export function joined(labels: readonly string[]): string | undefined {
  if (labels.length < 2) return labels[0];
  const named = labels.length > MAX_NAMES ? MAX_NAMES - 1 : labels.length - 1;
  const last = named + 1 < labels.length ? `${labels.length - named} more` : (labels[named] ?? "");
  return `${labels.slice(0, named).join(", ")} and ${last}`;
}

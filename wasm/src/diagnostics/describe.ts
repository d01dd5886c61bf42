/** Describes diagnostics of the engine: unpacks their arrays, names the entities, and fills in the sentences. */
import { PAUSE, type Steps } from "../base/steps.js";
import { ENGINE_OPTIONS, type EngineCode, engineCodeName } from "./codes.js";
import { type DiagnosticData, ENGINE_DATA } from "./data.js";
import type { Diagnostic, DiagnosticOf, EntityKind, EntityRef, Severity } from "./diagnostic.js";
import type { EntityNamer } from "./entity-names.js";
import { sentence } from "./package-diagnostic.js";
import { SENTENCES, short, type Subject } from "./sentences.js";

/** Diagnostic as the engine returns it. */
export interface EngineDiagnostic {
  readonly code: number;
  /** 0 information, 1 warning, 2 error. */
  readonly severity: number;
  /** Kind and index per entity, the most relevant first. */
  readonly entities: Uint32Array;
  /** x y z, or empty. */
  readonly place: Float64Array;
  readonly values: Float64Array;
}

/** All diagnostics of an answer in a few arrays: there may be a million of them. */
export interface DiagnosticArrays {
  /** Per diagnostic: code, severity, number of entities, 1 with a position, number of values. */
  readonly heads: Uint32Array;
  /** Kind and index per entity, one diagnostic after the other. */
  readonly entities: Uint32Array;
  /** x y z of the diagnostics with a position. */
  readonly positions: Float64Array;
  readonly values: Float64Array;
}

/** Severities by the engine's numbers. */
export const SEVERITIES: readonly Severity[] = ["information", "warning", "error"];

/** Entity kinds by the engine's numbers (cpp/include/tetrafront/status.h). */
export const ENTITY_KINDS: readonly EntityKind[] = [
  "point",
  "line",
  "patch",
  "background-node",
  "background-tetrahedron",
  "triangle",
  "surface-node",
  "source",
];

/** Numbers per diagnostic in `heads`: code, severity, number of entities, 1 if it has a position, number of values. */
export const HEAD_STRIDE = 5;

/** Yields the diagnostics of the engine one by one. */
export function* unpacked({
  heads,
  entities,
  positions,
  values,
}: DiagnosticArrays): Generator<EngineDiagnostic> {
  let [entity, place, value] = [0, 0, 0];
  for (let head = 0; head < heads.length; head += HEAD_STRIDE) {
    const [code = 0, severity = 0, entityCount = 0, placeCount = 0, valueCount = 0] = heads.subarray(
      head,
      head + HEAD_STRIDE,
    );
    yield {
      code,
      severity,
      entities: entities.subarray(entity, (entity += 2 * entityCount)),
      place: positions.subarray(place, (place += 3 * placeCount)),
      values: values.subarray(value, (value += valueCount)),
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
  const entities = namedEntities(raw.entities, name);
  const data = dataOf(code, raw.values);
  const subject = subjectOf<Code>(raw, entities, data);
  const { message, remedy } = SENTENCES[code];
  const [x, y, z] = raw.place;
  return {
    code,
    severity: SEVERITIES[raw.severity] ?? "error",
    message: sentence(withCounting(message(subject), entities)),
    remedy: typeof remedy === "string" ? remedy : remedy(subject),
    entities,
    ...(x !== undefined && y !== undefined && z !== undefined ? { position: [x, y, z] as const } : {}),
    data,
  };
}

/** Returns the engine's values by name. Throws if one is missing. */
export function dataOf<Code extends EngineCode>(code: Code, values: Float64Array): DiagnosticData[Code] {
  const data: Record<string, unknown> = {};
  ENGINE_DATA[code]?.forEach((entry, i) => {
    const name = entry.replace(/\?$/, "");
    const value = values[i];
    if (value === undefined) {
      if (name === entry) throw new Error(`the engine returned no ${name} with ${code}`);
    } else if (name === "option") {
      data[name] = ENGINE_OPTIONS[value];
    } else {
      data[name] = name.startsWith("is") ? value === 1 : value;
    }
  });
  // `ENGINE_DATA` is checked against this type.
  return data as DiagnosticData[Code];
}

/** Adds to the first label with an index that indices count from 0. */
export function withCounting(message: string, entities: readonly EntityRef[]): string {
  const places = entities
    .filter(({ id }) => id === undefined)
    .flatMap(({ label }) => {
      let at = message.indexOf(label);
      // "triangle 1" also begins "triangle 12".
      while (at >= 0 && /\d/.test(message.charAt(at + label.length))) at = message.indexOf(label, at + 1);
      return at < 0 ? [] : [at + label.length];
    });
  if (places.length === 0) return message;
  const end = Math.min(...places);
  return `${message.slice(0, end)} (counted from 0)${message.slice(end)}`;
}

export function namedEntities(pairs: Uint32Array, name: EntityNamer): EntityRef[] {
  const named: EntityRef[] = [];
  for (let i = 0; i + 1 < pairs.length; i += 2) {
    const kind = ENTITY_KINDS[pairs[i] ?? 0];
    if (kind !== undefined) named.push(name(kind, pairs[i + 1] ?? 0));
  }
  return named;
}

export function subjectOf<Code extends EngineCode>(
  raw: EngineDiagnostic,
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
    at: raw.place.length === 3 ? ` at (${[...raw.place].map(short).join(", ")})` : "",
    main: entities[0]?.label ?? "the model",
    kind: entities[0]?.kind,
    drawn,
  };
}

/** Largest number of names in a message; of more, the rest is counted. */
export const MAX_NAMES = 8;

export function joined(labels: readonly string[]): string | undefined {
  if (labels.length < 2) return labels[0];
  const named = labels.length > MAX_NAMES ? MAX_NAMES - 1 : labels.length - 1;
  const last = named + 1 < labels.length ? `${labels.length - named} more` : (labels[named] ?? "");
  return `${labels.slice(0, named).join(", ")} and ${last}`;
}

/** What a list of ids must hold, and the messages if it does not. */
export interface IdRule {
  readonly known: ReadonlySet<number>;
  readonly atLeast: number;
  readonly tooFew: string;
  readonly unknown: (id: string) => string;
}

/** Returns why a list of ids is invalid, or null if it is valid. The sign of an id has no effect. */
export function refuseIds(
  ids: readonly number[],
  { known, atLeast, tooFew, unknown }: IdRule,
): string | null {
  if (ids.length < atLeast) return tooFew;
  const wrong = ids.find((id) => !known.has(Math.abs(id)));
  return wrong === undefined ? null : unknown(String(Math.abs(wrong)));
}

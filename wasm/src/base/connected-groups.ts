/** Returns the indices below `count` in groups that are connected by pairs, by their first ones; each is in one group. */
export function connectedGroups(count: number, pairs: readonly (readonly [number, number])[]): number[][] {
  const groupOf = Array.from({ length: count }, (_, index) => [index]);
  for (const [one, other] of pairs) {
    const [into = [], from = []] = [groupOf[one], groupOf[other]];
    if (into === from) continue;
    into.push(...from);
    for (const index of from) groupOf[index] = into;
  }
  return [...new Set(groupOf)]
    .map((group) => group.toSorted((a, b) => a - b))
    .sort(([a = 0], [b = 0]) => a - b);
}

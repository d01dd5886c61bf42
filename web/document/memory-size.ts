/** Elements of a list that are measured; they stand for the rest, because lists hold records of one kind. */
const sampleSize = 64;

/**
 * Estimates the memory of plain data, in bytes. Data that several parents share is counted for each of them. The
 * cost does not depend on the length of lists.
 */
export function memorySize(value: unknown): number {
  if (typeof value === "string") return 16 + 2 * value.length;
  if (ArrayBuffer.isView(value)) return 64 + value.byteLength;
  if (typeof value !== "object" || value === null) return 8;
  if (!Array.isArray(value)) return 16 + sum(Object.values(value), (part) => 8 + memorySize(part));
  const list: readonly unknown[] = value;
  if (list.length === 0) return 16;
  const sample = list.slice(0, sampleSize);
  return 16 + (list.length / sample.length) * sum(sample, memorySize);
}

const sum = <T>(list: readonly T[], valueOf: (item: T) => number): number =>
  list.reduce((total, item) => total + valueOf(item), 0);

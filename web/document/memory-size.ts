import { minLongText } from "./long-texts";

/** Lists up to this length are measured as a whole. */
const maxMeasured = 1000;
/** Elements of a longer list that are measured; they stand for the rest, because such lists hold records of one kind. */
const sampleSize = 64;

/**
 * Estimates the memory of plain data, in bytes. Data that several parents share is counted for each of them, except
 * long texts: these are added to `longTexts` instead. The cost does not depend on the length of long lists.
 */
export function memorySize(value: unknown, longTexts: Set<string> = new Set()): number {
  if (typeof value === "string") {
    if (value.length < minLongText) return 16 + 2 * value.length;
    longTexts.add(value);
    return 16;
  }
  if (ArrayBuffer.isView(value)) return 64 + value.byteLength;
  if (typeof value !== "object" || value === null) return 8;
  const measure = (part: unknown): number => memorySize(part, longTexts);
  if (!Array.isArray(value)) return 16 + sum(Object.values(value), (part) => 8 + measure(part));
  const list: readonly unknown[] = value;
  if (list.length === 0) return 16;
  const sample = list.length <= maxMeasured ? list : list.slice(0, sampleSize);
  return 16 + (list.length / sample.length) * sum(sample, measure);
}

/** Returns the memory of a long text, in bytes: it holds the digits of base64, one byte each. */
export const textSize = (text: string): number => text.length;

const sum = <T>(list: readonly T[], valueOf: (item: T) => number): number =>
  list.reduce((total, item) => total + valueOf(item), 0);

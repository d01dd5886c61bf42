import { inPieces } from "../base/steps.js";

type Numbers = Float64Array | Uint32Array | Int32Array | Uint8Array;

/**
 * Yields one line per `width` values, formatted by `line`; the lines are made when they are requested, a slice at a
 * time.
 */
export function numberRows(
  values: Numbers,
  width: number,
  line: (row: Numbers, index: number) => string,
): Generator<string, void> {
  return inPieces(values.length / width, (begin, end) => {
    let piece = "";
    for (let row = begin; row < end; row++) {
      piece += `${line(values.subarray(width * row, width * (row + 1)), row)}\n`;
    }
    return piece;
  });
}

/** Formats the nodes of a row, counted from 1. */
export function fromOne(row: Numbers, separator = " "): string {
  let text = "";
  for (let i = 0; i < row.length; i++) text += `${i === 0 ? "" : separator}${(row[i] ?? 0) + 1}`;
  return text;
}

/** Formats doubles as decimals that restore them bit for bit, including the sign of zero. */
export function coordinates(row: Numbers, separator = " "): string {
  let text = "";
  for (let i = 0; i < row.length; i++) {
    const value = row[i] ?? 0;
    text += `${i === 0 ? "" : separator}${Object.is(value, -0) ? "-0" : value}`;
  }
  return text;
}

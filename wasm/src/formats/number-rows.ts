import { inPieces } from "./steps.js";

type Numbers = Float64Array | Uint32Array | Int32Array | Uint8Array;

/** One line per `width` values, as `line` puts it, made while they are asked for, a step at a time. */
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

/** The nodes of a row, counted from 1. */
export function fromOne(row: Numbers, separator = " "): string {
  let text = "";
  for (let i = 0; i < row.length; i++) text += `${i === 0 ? "" : separator}${(row[i] ?? 0) + 1}`;
  return text;
}

/** The doubles of a row as decimals that give them back bit for bit, the sign of zero too. */
export function coordinates(row: Numbers, separator = " "): string {
  let text = "";
  for (let i = 0; i < row.length; i++) {
    const value = row[i] ?? 0;
    text += `${i === 0 ? "" : separator}${Object.is(value, -0) ? "-0" : value}`;
  }
  return text;
}

/** Lines are joined in pieces of so many, each a few milliseconds of work. */
const ROWS_PER_PIECE = 1 << 13;

type Numbers = Float64Array | Uint32Array | Int32Array | Uint8Array;

/** One line per `width` values, as `line` puts it, made while they are asked for. */
export function* numberRows(
  values: Numbers,
  width: number,
  line: (row: Numbers, index: number) => string,
): Generator<string, void> {
  const count = values.length / width;
  for (let begin = 0; begin < count; begin += ROWS_PER_PIECE) {
    let piece = "";
    const end = Math.min(begin + ROWS_PER_PIECE, count);
    for (let row = begin; row < end; row++) {
      piece += `${line(values.subarray(width * row, width * (row + 1)), row)}\n`;
    }
    yield piece;
  }
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

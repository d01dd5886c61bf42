/** Lines are joined in pieces of so many: one text for all would exceed the longest string. */
const ROWS_PER_PIECE = 1 << 16;

type Numbers = Float64Array | Uint32Array | Int32Array | Uint8Array;

/** One line per `width` values, as `line` puts it; doubles as the shortest decimals that give them back. */
export function numberRows(
  values: Numbers,
  width: number,
  line: (row: Numbers, index: number) => string,
): string[] {
  const count = values.length / width;
  const pieces: string[] = [];
  for (let begin = 0; begin < count; begin += ROWS_PER_PIECE) {
    const rows = Array.from({ length: Math.min(ROWS_PER_PIECE, count - begin) }, (_, i) => {
      const row = begin + i;
      return `${line(values.subarray(width * row, width * (row + 1)), row)}\n`;
    });
    pieces.push(rows.join(""));
  }
  return pieces;
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

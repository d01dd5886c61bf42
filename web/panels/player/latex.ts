/** Returns lines of a formula, below each other: the panel may be as narrow as 250 pixels. */
export const linesOf = (...lines: readonly string[]): string =>
  String.raw`\begin{aligned}&${lines.join(String.raw`\\&`)}\end{aligned}`;

/** Returns a number in LaTeX, with three digits. */
export function digits(value: number): string {
  const [mantissa = "", exponent] = String(Number(value.toPrecision(3))).split("e");
  if (exponent === undefined) return mantissa;
  const power = `10^{${Number(exponent)}}`;
  return mantissa === "1" ? power : String.raw`${mantissa}\cdot${power}`;
}

/** Returns a number in LaTeX, with three digits. */
export function digits(value: number): string {
  const [mantissa = "", exponent] = String(Number(value.toPrecision(3))).split("e");
  if (exponent === undefined) return mantissa;
  const power = `10^{${Number(exponent)}}`;
  return mantissa === "1" ? power : String.raw`${mantissa}\cdot${power}`;
}

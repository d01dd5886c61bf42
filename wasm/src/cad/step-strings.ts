/** Texts in STEP files. */

/** Returns a text of a STEP file without its escapes: quotes, and characters outside of ASCII (ISO 10303-21, 6.4.3). */
export function plainText(text: string): string {
  const decoded = (hex: string, digits: number) =>
    (hex.match(new RegExp(`.{${digits}}`, "g")) ?? []).map((code) => codePoint(parseInt(code, 16))).join("");
  return text
    .replaceAll("''", "'")
    .replace(/\\X2\\([\dA-F]*)\\X0\\/gi, (_, hex: string) => decoded(hex, 4))
    .replace(/\\X4\\([\dA-F]*)\\X0\\/gi, (_, hex: string) => decoded(hex, 8))
    .replace(/\\X\\([\dA-F]{2})/gi, (_, hex: string) => decoded(hex, 2))
    .replace(/\\S\\(.)/g, (_, letter: string) => codePoint(letter.charCodeAt(0) + 128))
    .replaceAll("\\\\", "\\")
    .trim();
}

const codePoint = (code: number) => (code <= 0x10ffff ? String.fromCodePoint(code) : "\ufffd");

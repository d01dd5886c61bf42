/** Returns the beginning of a text that can be of any length, at most so many characters of it. */
export const shortened = (text: string, maxLength: number): string =>
  text.length > maxLength ? `${text.slice(0, maxLength)}…` : text;

/** Text in drawings (SVG). */

/** Size of the type, and the average width of its letters, in pixels. */
export const svgFont = 11;
export const letterWidth = 6.3;

export const escaped = (text: string): string =>
  text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

/**
 * Styles that are computed in the page. The policy of the page forbids style elements; a style sheet that a script makes is
 * not one.
 */

/** Adds styles to the page, with precedence over those before. Returns a function that removes them. */
export function adoptStyles(css: string): () => void {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(css);
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
  return () => {
    document.adoptedStyleSheets = document.adoptedStyleSheets.filter((other) => other !== sheet);
  };
}

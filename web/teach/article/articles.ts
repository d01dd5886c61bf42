/** Numbers of the lessons that are articles, with pages of their own; a test compares them with the files in `web/lessons`. */
const articles: readonly number[] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11];

/** Returns the address of a lesson's article, relative to the app; null if it has none. */
export const articleOf = (lesson: number): string | null =>
  articles.includes(lesson) ? `./lessons/${lesson}/` : null;

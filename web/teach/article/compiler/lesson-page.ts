/** The HTML of the pages of lessons. Vite adds scripts and styles, scripts/lib/site-policy.mjs the policy. */
import type { CompiledLesson } from "./compile-lesson.ts";
import { attribute } from "./formulas.ts";
import { emblemOf } from "./lesson-emblems.ts";

export interface ListedLesson {
  readonly number: number;
  readonly title: string;
  readonly summary: string;
}

const themeScript = `
      // The colours that the app has remembered, before anything is drawn.
      try {
        const chosen = localStorage.getItem("mantine-color-scheme-value");
        if (chosen === "dark" || chosen === "light") document.documentElement.dataset.theme = chosen;
      } catch {
        // Without storage, the page has the colours of the system.
      }
    `;

/** Returns a page. `root` leads from it to the root of the site. */
function page(title: string, description: string, root: string, css: string, body: string): string {
  return `<!doctype html>
<html lang="en" data-root="${root}">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="light dark" />
    <meta name="theme-color" media="(prefers-color-scheme: dark)" content="#14171c" />
    <meta name="theme-color" media="(prefers-color-scheme: light)" content="#fbfaf7" />
    <meta name="description" content="${attribute(description)}" />
    <link rel="icon" type="image/svg+xml" href="${root}icon.svg" />
    <title>${attribute(title)}</title>
    <script>${themeScript}</script>
    ${css === "" ? "" : `<style>${css}</style>`}
  </head>
  <body>
${body}
    <script type="module" src="/teach/article/runtime/start-lesson.ts"></script>
  </body>
</html>
`;
}

const header = (links: string): string =>
  `<header class="top"><nav aria-label="Site">${links}</nav><button id="theme" type="button" aria-label="Dark or light" title="Dark or light"><span></span></button></header>`;

/** Returns the page of one lesson, or with null one beside the lessons; `all` are the written lessons in their order. */
export function lessonPage(
  number: number | null,
  lesson: CompiledLesson,
  all: readonly ListedLesson[],
): string {
  const index = all.findIndex((each) => each.number === number);
  const [before, next] = number === null ? [] : [all[index - 1], all[index + 1]];
  const link = (each: ListedLesson | undefined, rel: string, label: string): string =>
    each
      ? `<a rel="${rel}" href="../${each.number}/"><span>${label}</span>${each.number}. ${attribute(each.title)}</a>`
      : "<span></span>";
  const body = `${header('<a href="../">Lessons</a><a href="../../">Tetrafront</a>')}
<main>
<p class="number">${number === null ? "A game" : `Lesson ${number}`}</p>
${lesson.html}
<nav class="next" aria-label="Lessons">${link(before, "prev", "Before")}${link(next, "next", "Next")}</nav>
</main>`;
  return page(`${lesson.title} – Tetrafront`, lesson.summary, "../../", lesson.css, body);
}

/** Returns the page that lists all written lessons. */
export function lessonListPage(all: readonly ListedLesson[]): string {
  const entry = (page: number | string, digit: string, title: string, summary: string): string =>
    `<li><a href="./${page}/"><span class="digit">${digit}</span><h2>${attribute(title)}</h2><p>${attribute(summary)}</p>${emblemOf(page)}</a></li>`;
  const entries = all.map(({ number, title, summary }) => entry(number, String(number), title, summary));
  const game = entry(
    "mesher",
    "",
    "Be the mesher",
    "A game: advance a front yourself, and see your mesh beside the program’s.",
  );
  const body = `${header('<a href="../">Tetrafront</a>')}
<main class="contents">
<h1>The advancing front</h1>
<p class="lead">How a computer fills a shape with triangles and tetrahedra. Each lesson is one article, and each figure is the method itself: drag everything.</p>
<ol>${entries.join("")}${game}</ol>
</main>`;
  return page("Lessons – Tetrafront", "Lessons about the advancing-front method", "../", "", body);
}

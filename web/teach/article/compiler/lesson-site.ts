/** The pages of the lessons as entries of Vite: `lessons/index.html` and `lessons/N/index.html`, made from `web/lessons/N.md`. */
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import type { Plugin } from "vite";
import { declarations } from "../declarations.ts";
import { compileLesson, type CompiledLesson } from "./compile-lesson.ts";
import { LessonError } from "./lesson-error.ts";
import { lessonListPage, lessonPage } from "./lesson-page.ts";

export interface LessonFolders {
  /** Root of the app; the pages are in its virtual folder `lessons`. */
  readonly root: string;
  /** Folder of the Markdown files. */
  readonly sources: string;
  /** Path of the list of models. */
  readonly models: string;
}

/** Returns the numbers of the written lessons, ascending. */
export function lessonNumbers(sources: string): readonly number[] {
  return readdirSync(sources)
    .flatMap((name) => /^(\d+)\.md$/.exec(name)?.[1] ?? [])
    .map(Number)
    .toSorted((a, b) => a - b);
}

/** Names of the pages beside the lessons, which have no number. */
const otherPages = ["mesher"] as const;

/** Returns the entries of the bundler. */
export const lessonEntries = ({ root, sources }: LessonFolders): readonly string[] =>
  ["index.html", ...[...lessonNumbers(sources), ...otherPages].map((name) => `${name}/index.html`)].map(
    (name) => path.join(root, "lessons", name),
  );

/** Returns a page by its path below `lessons`; null if there is none. Throws LessonError. */
export function makeLessonPage(name: string, folders: LessonFolders): string | null {
  const numbers = lessonNumbers(folders.sources);
  const gallery = JSON.parse(readFileSync(folders.models, "utf8")) as {
    readonly models: readonly { readonly id: string }[];
  };
  const models = gallery.models.map(({ id }) => id);
  const compile = (page: number | string): CompiledLesson => {
    const file = path.join(folders.sources, `${page}.md`);
    const context = { declarations, lessons: numbers, models };
    return compileLesson(readFileSync(file, "utf8"), path.relative(process.cwd(), file), context);
  };
  const compiled = new Map<number, CompiledLesson>(numbers.map((number) => [number, compile(number)]));
  const all = [...compiled].map(([number, { title, summary }]) => ({ number, title, summary }));
  if (name === "index.html") return lessonListPage(all);
  const other = otherPages.find((each) => name === `${each}/index.html`);
  if (other) return lessonPage(null, compile(other), all);
  const number = Number(/^(\d+)\/index\.html$/.exec(name)?.[1] ?? NaN);
  const lesson = compiled.get(number);
  return lesson ? lessonPage(number, lesson, all) : null;
}

export function lessonSite(folders: LessonFolders): Plugin {
  const virtual = path.join(folders.root, "lessons") + path.sep;
  const nameOf = (file: string): string => file.slice(virtual.length).split(path.sep).join("/");
  let isBuilt = false;
  const isPage = (id: string): boolean => id.startsWith(virtual) && id.endsWith(".html");
  return {
    name: "tetrafront:lesson-site",
    enforce: "pre",
    configResolved: ({ command }) => {
      isBuilt = command === "build";
    },
    // A mistake ends a build at once, and is told once, not for each page. The server of the development tells it on the page.
    buildStart() {
      if (!isBuilt) return;
      try {
        for (const name of ["", ...otherPages.map((each) => `${each}/`)])
          makeLessonPage(`${name}index.html`, folders);
      } catch (error) {
        if (!(error instanceof LessonError)) throw error;
        // Where the compiler found it says nothing to an author.
        this.error({ message: error.message, stack: "" });
      }
    },
    resolveId: (source) => (isPage(source) ? source : null),
    load: (id) => (isPage(id) ? makeLessonPage(nameOf(id), folders) : null),
    configureServer(server) {
      server.watcher.add(folders.sources);
      server.watcher.on("change", (file) => {
        if (file.startsWith(folders.sources)) server.hot.send({ type: "full-reload" });
      });
      server.middlewares.use((request, response, next) => {
        const [, name] =
          /^\/lessons\/((?:(?:\d+|mesher)\/)?)(?:index\.html)?(?:\?.*)?$/.exec(request.url ?? "") ?? [];
        const html = name === undefined ? null : makeLessonPage(`${name}index.html`, folders);
        if (html === null) return next();
        server
          .transformIndexHtml(request.url ?? "/", html)
          .then((text) => response.setHeader("Content-Type", "text/html").end(text))
          .catch(next);
      });
    },
  };
}

// Adds the traces of lessons to the site: traces/NAME.tft, recorded while the site is built.
import { recordLessonTraces } from "./lesson-traces.mjs";

export function lessonTraces() {
  return {
    name: "tetrafront:lesson-traces",
    async generateBundle() {
      for (const [name, source] of Object.entries(await recordLessonTraces()))
        this.emitFile({ type: "asset", fileName: `traces/${name}.tft`, source });
    },
    /** The development server records them when the first is asked for. */
    configureServer({ middlewares }) {
      let recording;
      middlewares.use((request, answer, next) => {
        const name = /\/traces\/(\w+)\.tft$/.exec(request.url ?? "")?.[1];
        if (name === undefined) return next();
        recording ??= recordLessonTraces();
        recording.then((files) => (files[name] ? answer.end(files[name]) : next()), next);
      });
    },
  };
}

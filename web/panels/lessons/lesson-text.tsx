import "katex/dist/katex.min.css";
import { useRef } from "react";
import Markdown, { type Components } from "react-markdown";
import rehypeKatex from "rehype-katex";
import remarkGfm from "remark-gfm";
import remarkMath from "remark-math";
import { useScrollFocus } from "../../ui/use-scroll-focus";
import tables from "../../ui/table.module.css";
import styles from "./lessons.module.css";

const remarkPlugins = [remarkGfm, remarkMath];
const rehypePlugins = [rehypeKatex];

const components: Components = {
  table: ({ children }) => (
    <div className={styles["tableBox"]} data-table>
      <table className={tables["table"]}>{children}</table>
    </div>
  ),
};

/** The text of a lesson, with tables. Formulas and tables wider than the panel scroll, also with the keys. */
export function LessonText({ text }: { readonly text: string }) {
  const box = useRef<HTMLDivElement>(null);
  useScrollFocus(box, ".katex-display, [data-table]", text);
  return (
    <div ref={box} className={styles["text"]}>
      <Markdown remarkPlugins={remarkPlugins} rehypePlugins={rehypePlugins} components={components}>
        {text}
      </Markdown>
    </div>
  );
}

import "katex/dist/katex.min.css";
import { useRef } from "react";
import Markdown from "react-markdown";
import rehypeKatex from "rehype-katex";
import remarkMath from "remark-math";
import { useScrollFocus } from "../../ui/use-scroll-focus";
import styles from "./lessons.module.css";

const remarkPlugins = [remarkMath];
const rehypePlugins = [rehypeKatex];

/** The text of a lesson. Formulas wider than the panel scroll, also with the keys. */
export function LessonText({ text }: { readonly text: string }) {
  const box = useRef<HTMLDivElement>(null);
  useScrollFocus(box, ".katex-display", text);
  return (
    <div ref={box} className={styles["text"]}>
      <Markdown remarkPlugins={remarkPlugins} rehypePlugins={rehypePlugins}>
        {text}
      </Markdown>
    </div>
  );
}

import "katex/dist/katex.min.css";
import { useEffect, useRef } from "react";
import Markdown from "react-markdown";
import rehypeKatex from "rehype-katex";
import remarkMath from "remark-math";
import styles from "./lessons.module.css";

const remarkPlugins = [remarkMath];
const rehypePlugins = [rehypeKatex];

/** The text of a lesson. Formulas wider than the panel scroll, also with the keys. */
export function LessonText({ text }: { readonly text: string }) {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = box.current;
    if (!element) return undefined;
    const watch = new ResizeObserver(() => focusScrolling(element));
    watch.observe(element);
    return () => watch.disconnect();
  }, [text]);
  return (
    <div ref={box} className={styles["text"]}>
      <Markdown remarkPlugins={remarkPlugins} rehypePlugins={rehypePlugins}>
        {text}
      </Markdown>
    </div>
  );
}

/** Lets the keyboard reach the formulas and tables that scroll, and only those. */
function focusScrolling(box: HTMLElement): void {
  for (const formula of box.querySelectorAll<HTMLElement>(".katex-display")) {
    if (formula.scrollWidth > formula.clientWidth) formula.tabIndex = 0;
    else formula.removeAttribute("tabindex");
  }
}

import katex from "katex";
import "katex/dist/katex.min.css";
import { useLayoutEffect, useRef } from "react";
import Markdown, { type Components } from "react-markdown";
import remarkGfm from "remark-gfm";
import remarkMath from "remark-math";
import { useScrollFocus } from "../../../ui/use-scroll-focus";
import tables from "../../../ui/table.module.css";
import styles from "./lessons.module.css";

const remarkPlugins = [remarkGfm, remarkMath];

/** Code in which remark-math puts formulas: `math-display` for those with a line of their own. */
const formula = /\bmath-(inline|display)\b/;

const components: Components = {
  table: ({ children }) => (
    <div className={styles["tableBox"]} data-table>
      <table className={tables["table"]}>{children}</table>
    </div>
  ),
  code: ({ className = "", children }) => {
    const [, place] = formula.exec(className) ?? [];
    if (place === undefined) return <code className={className}>{children}</code>;
    return <MathText text={typeof children === "string" ? children : ""} isDisplayed={place === "display"} />;
  },
  pre: ({ node, children }) => {
    const [code] = node?.children ?? [];
    const isFormula = code?.type === "element" && formula.test(String(code.properties["className"]));
    return isFormula ? children : <pre>{children}</pre>;
  },
};

interface MathTextProps {
  readonly text: string;
  readonly isDisplayed: boolean;
}

/** A formula in LaTeX, made of elements: the policy of the page forbids style attributes in HTML. */
function MathText({ text, isDisplayed }: MathTextProps) {
  const box = useRef<HTMLSpanElement>(null);
  useLayoutEffect(() => {
    if (box.current) katex.render(text, box.current, { displayMode: isDisplayed, throwOnError: false });
  }, [text, isDisplayed]);
  return <span ref={box} />;
}

/** The text of a lesson, with tables. Formulas and tables wider than the panel scroll, also with the keys. */
export function LessonText({ text }: { readonly text: string }) {
  const box = useRef<HTMLDivElement>(null);
  useScrollFocus(box, ".katex-display, [data-table]", text);
  return (
    <div ref={box} className={styles["text"]}>
      <Markdown remarkPlugins={remarkPlugins} components={components}>
        {text}
      </Markdown>
    </div>
  );
}

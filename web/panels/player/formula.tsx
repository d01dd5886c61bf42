import katex from "katex";
import "katex/dist/katex.min.css";
import { useLayoutEffect, useRef } from "react";
import { useScrollFocus } from "../../ui/use-scroll-focus";
import styles from "./player.module.css";

/** A formula in LaTeX; screen readers get MathML. One that is too wide scrolls, also with the keys. */
export function Formula({ text }: { readonly text: string }) {
  const box = useRef<HTMLDivElement>(null);
  const formula = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    // As elements: the policy of the page forbids style attributes in HTML.
    if (formula.current) katex.render(text, formula.current, { throwOnError: false });
  }, [text]);
  useScrollFocus(box, "p", text);
  return (
    <div ref={box}>
      <p ref={formula} className={styles["formula"]} />
    </div>
  );
}

import katex from "katex";
import "katex/dist/katex.min.css";
import { useLayoutEffect, useRef } from "react";
import { useScrollFocus } from "../../../ui/use-scroll-focus";
import { playerStrings } from "../../strings/player";
import styles from "./player.module.css";

/**
 * A formula in LaTeX, in parts between which it may be broken; screen readers get MathML. A part that is too wide scrolls, also
 * with the keys.
 */
export function Formula({ parts }: { readonly parts: readonly string[] }) {
  const text = parts.join("\n");
  const box = useRef<HTMLDivElement>(null);
  const formula = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    // As elements: the policy of the page forbids style attributes in HTML.
    const spans = formula.current?.children ?? [];
    text.split("\n").forEach((part, i) => {
      const span = spans[i];
      if (span instanceof HTMLElement) katex.render(part, span, { throwOnError: false });
    });
  }, [text]);
  useScrollFocus(box, "p", text);
  return (
    <div ref={box}>
      <p ref={formula} className={styles["formula"]}>
        {parts.map((_, i) => (
          // Parts have no identity beside their order.
          <span key={i} className={styles["part"]} />
        ))}
      </p>
    </div>
  );
}

/** What the letters of a formula mean: closed, so that all formulas of a step are in view. */
export function FormulaMeaning({ children }: { readonly children: string }) {
  return (
    <details className={styles["meanings"]}>
      <summary>{playerStrings.formulaMeaning}</summary>
      <p className={styles["hint"]}>{children}</p>
    </details>
  );
}

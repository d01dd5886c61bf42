import katex from "katex";
import "katex/dist/katex.min.css";
import { useMemo, useRef } from "react";
import { useScrollFocus } from "../../ui/use-scroll-focus";
import styles from "./player.module.css";

/** A formula in LaTeX; screen readers get MathML. One that is too wide scrolls, also with the keys. */
export function Formula({ text }: { readonly text: string }) {
  const html = useMemo(() => katex.renderToString(text, { throwOnError: false }), [text]);
  const box = useRef<HTMLDivElement>(null);
  useScrollFocus(box, "p", text);
  return (
    <div ref={box}>
      <p className={styles["formula"]} dangerouslySetInnerHTML={{ __html: html }} />
    </div>
  );
}

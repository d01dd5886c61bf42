import katex from "katex";
import "katex/dist/katex.min.css";
import { useMemo } from "react";
import styles from "./player.module.css";

/** A formula in LaTeX; screen readers get MathML. */
export function Formula({ text }: { readonly text: string }) {
  const html = useMemo(() => katex.renderToString(text, { throwOnError: false }), [text]);
  return <p className={styles["formula"]} dangerouslySetInnerHTML={{ __html: html }} />;
}

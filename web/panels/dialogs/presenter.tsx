import { Button } from "@mantine/core";
import { useEffect, useRef, useState } from "react";
import { strings } from "../../strings";
import { useApp, useShell } from "../shared/app-context";
import styles from "./presenter.module.css";

const texts = strings.presenter;

/** Large type for an audience (base.css), and a laser pointer. */
export function Presenter() {
  const isOn = useShell((state) => state.isPresenting);
  return isOn ? <Presentation /> : null;
}

function Presentation() {
  const app = useApp();
  const [hasLaser, setLaser] = useState(false);
  useEffect(() => {
    const { dataset } = document.documentElement;
    dataset["presenter"] = "";
    return () => void delete dataset["presenter"];
  }, []);
  return (
    <>
      <section className={styles["bar"]} aria-label={texts.title} data-testid="presenter">
        <Button
          size="compact-md"
          variant={hasLaser ? "filled" : "default"}
          aria-pressed={hasLaser}
          data-testid="presenter-laser"
          onClick={() => setLaser(!hasLaser)}
        >
          {texts.laser}
        </Button>
        <Button
          size="compact-md"
          variant="default"
          data-testid="presenter-end"
          onClick={() => app.shell.setState({ isPresenting: false })}
        >
          {texts.end}
        </Button>
      </section>
      {hasLaser && <Laser />}
    </>
  );
}

/** A red dot at the pointer, above everything else. It takes no clicks. */
function Laser() {
  const dot = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const life = new AbortController();
    const options = { capture: true, passive: true, signal: life.signal };
    const follow = ({ clientX, clientY }: PointerEvent): void => {
      if (!dot.current) return;
      dot.current.hidden = false;
      dot.current.style.translate = `${clientX}px ${clientY}px`;
    };
    const hide = (): void => {
      if (dot.current) dot.current.hidden = true;
    };
    for (const name of ["pointermove", "pointerdown"] as const)
      window.addEventListener(name, follow, options);
    // Not captured: the pointer leaves the elements of the page all the time.
    document.documentElement.addEventListener("pointerleave", hide, { ...options, capture: false });
    return () => life.abort();
  }, []);
  return <div ref={dot} hidden aria-hidden className={styles["laser"]} data-testid="laser" />;
}

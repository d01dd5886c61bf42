import { UnstyledButton } from "@mantine/core";
import { useLayoutEffect, useRef, type PointerEvent } from "react";
import { commandLabels, strings } from "../../strings";
import { cubePieces, cubeTransform } from "../../viewer/view-cube";
import type { Viewer } from "../../viewer/viewer";
import styles from "./view-cube.module.css";

/** A press that moves farther than this, in CSS pixels, is a drag. */
const dragThreshold = 4;
/** A drag across the cube turns the camera by a half turn. */
const degreesPerPixel = 2;

/** A cube that turns with the model: a click on a piece of it looks from there, and a drag turns the camera. */
export function ViewCube({ viewer }: { readonly viewer: Viewer }) {
  const cube = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const turn = (): void =>
      cube.current?.style.setProperty("transform", cubeTransform(viewer.camera.quaternion));
    turn();
    return viewer.onDrawn(turn);
  }, [viewer]);
  const { cube: label, cubeFaces } = strings.viewport;
  return (
    <div role="group" aria-label={label} className={styles["place"]} {...useDrag(viewer)}>
      <div ref={cube} className={styles["cube"]}>
        {cubePieces.map(({ direction, face, kind, transform }) => (
          <UnstyledButton
            key={direction.join()}
            className={`${styles["piece"]} ${styles[kind]}`}
            style={{ transform: `${transform} translate(-50%, -50%)` }}
            // The keyboard has the faces.
            {...(face ? { "aria-label": commandLabels.views[face] } : { "aria-hidden": true, tabIndex: -1 })}
            onClick={() => viewer.lookFrom(direction)}
          >
            {face && cubeFaces[face]}
          </UnstyledButton>
        ))}
      </div>
    </div>
  );
}

/** Returns the handlers of a drag that turns the camera. It takes the pointer, so that it does not end with a click. */
function useDrag(viewer: Viewer) {
  const from = useRef<{ readonly x: number; readonly y: number } | null>(null);
  return {
    onPointerDown: ({ button, clientX: x, clientY: y }: PointerEvent) => {
      from.current = button === 0 ? { x, y } : null;
    },
    onPointerMove: ({ buttons, clientX: x, clientY: y, currentTarget, pointerId }: PointerEvent) => {
      const last = buttons === 0 ? null : from.current;
      if (!last) return;
      const isDrag = currentTarget.hasPointerCapture(pointerId);
      if (!isDrag && Math.hypot(x - last.x, y - last.y) <= dragThreshold) return;
      if (!isDrag) currentTarget.setPointerCapture(pointerId);
      viewer.rotate(degreesPerPixel * (last.x - x), degreesPerPixel * (last.y - y));
      from.current = { x, y };
    },
  };
}

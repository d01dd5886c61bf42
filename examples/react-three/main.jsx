import React, { useEffect, useRef, useState } from "react";
import { createRoot } from "react-dom/client";
import { createMesher } from "tetrafront";

import { icosphere } from "./icosphere.js";
import { createScene } from "./scene.js";

const mesher = await createMesher();

function App() {
  const canvas = useRef(null);
  const scene = useRef(null);
  const stop = useRef(null);
  const [state, setState] = useState({ words: "Not meshed yet.", fraction: 0 });

  useEffect(() => {
    scene.current = createScene(canvas.current);
    return () => scene.current.dispose();
  }, []);

  async function mesh() {
    stop.current = new AbortController();
    const onProgress = ({ phase, fraction }) => setState({ words: phase, fraction });
    const { signal } = stop.current;
    const { mesh: made, report } = await mesher.fillSurface(
      icosphere(12),
      { size: 0.15 },
      { signal, onProgress },
    );
    setState({ words: `${report.status}: ${report.tetrahedra} tetrahedra`, fraction: 1 });
    if (report.status === "done") scene.current.show(made);
  }

  return (
    <>
      <canvas ref={canvas} aria-label="The mesh, cut open" role="img" />
      <button onClick={() => void mesh()}>Mesh</button>
      <button onClick={() => stop.current?.abort()}>Cancel</button>
      <progress value={state.fraction} aria-label="Progress" />
      <p role="status">{state.words}</p>
    </>
  );
}

createRoot(document.getElementById("root")).render(<App />);

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** Faces of a b c d, counter-clockwise seen from outside. */
const FACES = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
];

/** Creates a three.js scene in a canvas. It shows the elements of a mesh whose nodes all have x ≥ 0. */
export function createScene(canvas) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  const scene = new THREE.Scene();
  scene.background = new THREE.Color("white");
  scene.add(new THREE.HemisphereLight("white", "gray", 3));
  const camera = new THREE.PerspectiveCamera(45, 1, 0.01, 100);
  camera.position.set(-3, 1, 1);
  const controls = new OrbitControls(camera, canvas);
  const material = new THREE.MeshLambertMaterial({ color: "steelblue", flatShading: true });
  let shown;

  renderer.setAnimationLoop(() => {
    const { clientWidth, clientHeight } = canvas;
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / clientHeight;
    camera.updateProjectionMatrix();
    controls.update();
    renderer.render(scene, camera);
  });

  return {
    show({ points, tetrahedra }) {
      const corners = [];
      for (let t = 0; t < tetrahedra.length; t += 4) {
        const nodes = tetrahedra.subarray(t, t + 4);
        if (nodes.some((node) => points[3 * node] < 0)) continue;
        for (const face of FACES)
          for (const k of face) corners.push(...points.subarray(3 * nodes[k], 3 * nodes[k] + 3));
      }
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
      if (shown !== undefined) scene.remove(shown);
      shown?.geometry.dispose();
      shown = new THREE.Mesh(geometry, material);
      scene.add(shown);
      canvas.dataset.faces = String(corners.length / 9);
    },
    dispose() {
      renderer.setAnimationLoop(null);
      controls.dispose();
      renderer.dispose();
    },
  };
}

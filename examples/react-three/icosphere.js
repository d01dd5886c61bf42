import * as THREE from "three";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";

/** Returns the unit sphere as a surface. Any other closed three.js geometry can be converted in the same way. */
export function icosphere(detail) {
  const geometry = new THREE.IcosahedronGeometry(1, detail);
  geometry.deleteAttribute("normal");
  geometry.deleteAttribute("uv");
  const welded = mergeVertices(geometry, 1e-5);
  return {
    points: Float64Array.from(welded.attributes.position.array),
    triangles: Uint32Array.from(welded.index.array),
  };
}

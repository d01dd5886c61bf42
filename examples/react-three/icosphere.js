import * as THREE from "three";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";

/** The unit sphere: any closed three.js geometry becomes a surface like this. */
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

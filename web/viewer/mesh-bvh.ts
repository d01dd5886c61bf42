/** The one thing used of this library, so that the rest of it is left out. */
export { MeshBVH } from "three-mesh-bvh";

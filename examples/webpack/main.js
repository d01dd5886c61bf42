import { createMesher } from "tetrafront";

const points = Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1);
const triangles = Uint32Array.of(
  ...[0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4],
  ...[1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7],
);

const mesher = await createMesher();
const status = document.querySelector("#status");
const button = document.querySelector("#mesh");
button.addEventListener("click", async () => {
  const size = Number(document.querySelector("#size").value);
  // `fillSurface` keeps all triangles, so first split those that are larger than the size.
  const { mesh } = await mesher.refineSurface({ points, triangles }, { size });
  const { report } = await mesher.fillSurface(mesh, { size });
  status.textContent = `${report.status}: ${report.tetrahedra} tetrahedra of volume ${report.volume.toFixed(6)}`;
});
button.disabled = false;

/** Writes 3MF files: a zip of the model and of what refers to it. */
import type { SurfaceInput } from "tetrafront";
import { zipSync } from "fflate";

/** Returns the tags of a mesh; `attributes`: those of each triangle. */
export function meshTags(
  { points, triangles }: SurfaceInput,
  attributes: (triangle: number) => string = () => "",
): string {
  const vertices = Array.from({ length: points.length / 3 }, (_, p) => {
    const [x, y, z] = points.subarray(3 * p, 3 * p + 3);
    return `<vertex x="${x}" y="${y}" z="${z}"/>`;
  });
  const faces = Array.from({ length: triangles.length / 3 }, (_, t) => {
    const [a, b, c] = triangles.subarray(3 * t, 3 * t + 3);
    return `<triangle v1="${a}" v2="${b}" v3="${c}" ${attributes(t)}/>`;
  });
  return `<mesh><vertices>\n${vertices.join("\n")}\n</vertices><triangles>\n${faces.join("\n")}\n</triangles></mesh>`;
}

/** Returns a file with these resources and build items. */
export function threeMfFile(resources: string, items: string, unit = "millimeter"): Uint8Array {
  const model = `<?xml version="1.0" encoding="UTF-8"?>
<model unit="${unit}" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">
<metadata name="Title">a &gt; b</metadata>
<resources>${resources}</resources>
<build>${items}</build>
</model>`;
  return packedModel(new TextEncoder().encode(model));
}

/** Returns a file with this model part. */
export function packedModel(model: Uint8Array): Uint8Array {
  const types = `<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>`;
  const encode = (text: string) => new TextEncoder().encode(text);
  return zipSync(
    { "[Content_Types].xml": encode(types), "3D/3dmodel.model": model },
    { mtime: new Date(1990, 0, 1) },
  );
}

/** Writers of surface files, independent of the writers under test. */
import type { SurfaceInput } from "tetrafront";

const encoder = new TextEncoder();

export function offFile({ points, triangles }: SurfaceInput): Uint8Array {
  const lines = [`OFF`, `${points.length / 3} ${triangles.length / 3} 0`];
  for (let i = 0; i < points.length; i += 3) lines.push(points.subarray(i, i + 3).join(" "));
  for (let t = 0; t < triangles.length; t += 3) lines.push(`3 ${triangles.subarray(t, t + 3).join(" ")}`);
  return encoder.encode(`${lines.join("\n")}\n`);
}

/** Returns a TetGen `.smesh` file; nodes count from 1. `marks`: its holes and regions. */
export function smeshFile({ points, triangles }: SurfaceInput, marks: string): Uint8Array {
  const lines = [`${points.length / 3} 3 0 0`];
  for (let i = 0; i < points.length; i += 3)
    lines.push(`${i / 3 + 1} ${points.subarray(i, i + 3).join(" ")}`);
  lines.push(`${triangles.length / 3} 0`);
  for (let t = 0; t < triangles.length; t += 3)
    lines.push(
      `3 ${triangles
        .subarray(t, t + 3)
        .map((node) => node + 1)
        .join(" ")}`,
    );
  return encoder.encode(`${lines.join("\n")}\n${marks}`);
}

export function stlText({ points, triangles }: SurfaceInput, name = "part"): Uint8Array {
  const facets = Array.from({ length: triangles.length / 3 }, (_, t) => {
    const corners = [...triangles.subarray(3 * t, 3 * t + 3)].map(
      (node) => `      vertex ${points.subarray(3 * node, 3 * node + 3).join(" ")}\n`,
    );
    return `  facet normal 0 0 0\n    outer loop\n${corners.join("")}    endloop\n  endfacet\n`;
  });
  return encoder.encode(`solid ${name}\n${facets.join("")}endsolid ${name}\n`);
}

/** Returns a binary STL file; coordinates become float32. */
export function stlBinary({ points, triangles }: SurfaceInput, header = "made by a test"): Uint8Array {
  const count = triangles.length / 3;
  const bytes = new Uint8Array(84 + 50 * count);
  bytes.set(encoder.encode(header).subarray(0, 80));
  const view = new DataView(bytes.buffer);
  view.setUint32(80, count, true);
  triangles.forEach((node, corner) => {
    const begin = 84 + 50 * Math.floor(corner / 3) + 12 + 12 * (corner % 3);
    for (let axis = 0; axis < 3; axis++) {
      view.setFloat32(begin + 4 * axis, points[3 * node + axis] ?? NaN, true);
    }
  });
  return bytes;
}

export function objFile({ points, triangles }: SurfaceInput): Uint8Array {
  const lines = ["# made by a test", "mtllib none.mtl", "o part"];
  for (let i = 0; i < points.length; i += 3) lines.push(`v ${points.subarray(i, i + 3).join(" ")}`);
  lines.push("vn 0 0 1", "usemtl steel", "s off");
  for (let t = 0; t < triangles.length; t += 3) {
    lines.push(`f ${Array.from(triangles.subarray(t, t + 3), (node) => `${node + 1}//1`).join(" ")}`);
  }
  return encoder.encode(`${lines.join("\n")}\n`);
}

function plyHeader(format: string, points: number, faces: number, real: string): string {
  return `ply\nformat ${format} 1.0\ncomment made by a test
element vertex ${points}\nproperty ${real} x\nproperty ${real} y\nproperty ${real} z\nproperty uchar red
element face ${faces}\nproperty list uchar int vertex_indices\nend_header\n`;
}

export function plyText({ points, triangles }: SurfaceInput): Uint8Array {
  const lines: string[] = [];
  for (let i = 0; i < points.length; i += 3) lines.push(`${points.subarray(i, i + 3).join(" ")} 200`);
  for (let t = 0; t < triangles.length; t += 3) lines.push(`3 ${triangles.subarray(t, t + 3).join(" ")}`);
  const header = plyHeader("ascii", points.length / 3, triangles.length / 3, "double");
  return encoder.encode(`${header}${lines.join("\n")}\n`);
}

export function plyBinary({ points, triangles }: SurfaceInput, isLittleEndian: boolean): Uint8Array {
  const format = `binary_${isLittleEndian ? "little" : "big"}_endian`;
  const header = encoder.encode(plyHeader(format, points.length / 3, triangles.length / 3, "float64"));
  const view = new DataView(new ArrayBuffer((25 * points.length) / 3 + (13 * triangles.length) / 3));
  let at = 0;
  for (let i = 0; i < points.length; i++) {
    view.setFloat64(at, points[i] ?? NaN, isLittleEndian);
    at += i % 3 === 2 ? 9 : 8;
  }
  for (let t = 0; t < triangles.length; t++) {
    if (t % 3 === 0) view.setUint8(at++, 3);
    view.setInt32(at, triangles[t] ?? 0, isLittleEndian);
    at += 4;
  }
  return Uint8Array.of(...header, ...new Uint8Array(view.buffer));
}

/**
 * Returns a binary Geomview OFF file in single precision, with `extras` numbers after each point and orange
 * faces.
 */
export function offBinary({ points, triangles }: SurfaceInput, word: string, extras: number): Uint8Array {
  const numbers: DataView[] = [];
  const int = (value: number) => {
    numbers.push(new DataView(new ArrayBuffer(4)));
    numbers.at(-1)?.setInt32(0, value);
  };
  const float = (value: number) => {
    numbers.push(new DataView(new ArrayBuffer(4)));
    numbers.at(-1)?.setFloat32(0, value);
  };
  for (const count of [points.length / 3, triangles.length / 3, 0]) int(count);
  points.forEach((value, i) => {
    float(value);
    if (i % 3 === 2) for (let k = 0; k < extras; k++) float(7);
  });
  for (let t = 0; t < triangles.length; t += 3) {
    for (const value of [3, ...triangles.subarray(t, t + 3), 4]) int(value);
    for (const value of [1, 128 / 255, 0, 1]) float(value);
  }
  const bytes = numbers.map(({ buffer }) => new Uint8Array(buffer as ArrayBuffer));
  return new Uint8Array(Buffer.concat([encoder.encode(`${word} BINARY\n`), ...bytes]));
}

/** Returns a file with five points and one list of strips, which comes first if `isFirst`. */
export function plyStrips(corners: readonly number[], isFirst: boolean): Uint8Array {
  const points = ["0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 2 0"];
  const elements = [
    ["element vertex 5\nproperty double x\nproperty double y\nproperty double z\n", `${points.join("\n")}\n`],
    [
      "element tristrips 1\nproperty list int int vertex_indices\n",
      `${[corners.length, ...corners].join(" ")}\n`,
    ],
  ];
  if (isFirst) elements.reverse();
  const [heads, bodies] = [0, 1].map((part) => elements.map((element) => element[part]).join(""));
  return encoder.encode(`ply\nformat ascii 1.0\n${heads}end_header\n${bodies}`);
}

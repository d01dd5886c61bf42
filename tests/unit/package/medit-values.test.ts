/** Medit files with values at the nodes: `.mesh` with `.sol`, and the binary `.meshb` with `.solb`. */
import { spawnSync } from "node:child_process";

import { FILE_FORMATS, type Mesh, type OpenOther, readMesh, writeMesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const block = blockMesh();
const count = block.points.length / 3;
const values = (components: number) =>
  Float64Array.from({ length: components * count }, (_, i) => Math.sqrt(i + 2) - 3);
const withData = (entries: readonly (readonly [string, number])[]): Mesh => ({
  ...block,
  nodeData: new Map(entries.map(([name, components]) => [name, { components, values: values(components) }])),
});

async function written(mesh: Mesh, fileName: string) {
  const files = await writeMesh(mesh, fileName);
  const bytesOf = new Map(files.map((file) => [file.fileName, file.bytes]));
  const openOther: OpenOther = (name) => Promise.resolve(bytesOf.get(name));
  return { files, bytesOf, openOther };
}

async function readBack(mesh: Mesh, fileName: string): Promise<Mesh> {
  const { bytesOf, openOther } = await written(mesh, fileName);
  const read = await readMesh(bytesOf.get(fileName) ?? new Uint8Array(), { fileName, openOther });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

describe.each([".mesh", ".meshb"])("%s", (extension) => {
  test("has a format with a file for values", () => {
    const format = FILE_FORMATS.find(({ extensions }) => extensions.includes(extension));
    expect(format?.valuesExtension).toBe(extension.replace("mesh", "sol"));
  });

  test("keeps scalars, vectors and symmetric matrices bit for bit, with the mesh", async () => {
    const mesh = withData([
      ["temperature", 1],
      ["flow field", 3],
      ["stress", 6],
    ]);
    const read = await readBack(mesh, `a${extension}`);
    expect(read.points).toEqual(mesh.points);
    expect(read.triangles).toEqual(mesh.triangles);
    expect(read.tetrahedra).toEqual(mesh.tetrahedra);
    const names =
      extension === ".mesh" ? [...mesh.nodeData.keys()] : ["solution 1", "solution 2", "solution 3"];
    expect([...read.nodeData.keys()]).toEqual(names);
    expect([...read.nodeData.values()]).toEqual([...mesh.nodeData.values()]);
    const tags = ({ patches, trianglePatch }: Mesh) => [...trianglePatch].map((patch) => patches[patch]?.tag);
    expect(tags(read)).toEqual(tags(mesh));
  });

  test("writes only the metric of a background grid, as mmg expects", async () => {
    const mesh = withData([
      ["size", 1],
      ["stretching", 1],
      ["direction", 3],
      ["secondStretching", 1],
      ["secondDirection", 3],
      ["metric", 6],
    ]);
    const read = await readBack(mesh, `a${extension}`);
    expect([...read.nodeData]).toEqual([["metric", { components: 6, values: values(6) }]]);
  });

  test("has one file without values, and leaves out those of another kind", async () => {
    expect((await written(block, `a${extension}`)).files).toHaveLength(1);
    const { files } = await written(withData([["pair", 2]]), `a${extension}`);
    expect(files).toHaveLength(1);
    expect(files[0]?.notes.map(({ message }) => message)).toContain(
      'Values at the nodes are left out: "pair"',
    );
  });
});

describe("binary Medit files", () => {
  /** Returns the bytes of a file of this version and byte order with one tetrahedron, after the format's description. */
  function oneElement(version: number, isLittle: boolean): Uint8Array {
    const bytes: number[] = [];
    const add = (size: number, set: (view: DataView) => void) => {
      const view = new DataView(new ArrayBuffer(size));
      set(view);
      bytes.push(...new Uint8Array(view.buffer));
    };
    const int = (value: number) => add(4, (view) => view.setInt32(0, value, isLittle));
    const long = (value: number) => add(8, (view) => view.setBigInt64(0, BigInt(value), isLittle));
    const real = (value: number) =>
      version === 1
        ? add(4, (view) => view.setFloat32(0, value, isLittle))
        : add(8, (view) => view.setFloat64(0, value, isLittle));
    const index = version === 4 ? long : int;
    const sizes = { real: version === 1 ? 4 : 8, index: version === 4 ? 8 : 4, offset: version < 3 ? 4 : 8 };
    const section = (keyword: number, content: number, write: () => void) => {
      int(keyword);
      (version < 3 ? int : long)(bytes.length + sizes.offset + content);
      write();
    };
    int(1);
    int(version);
    section(3, 4, () => int(3));
    section(4, 5 * sizes.index + 12 * sizes.real, () => {
      index(4);
      for (const position of [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ]) {
        position.forEach(real);
        index(0);
      }
    });
    // Corners, which are skipped.
    section(13, 2 * sizes.index, () => [1, 4].forEach(index));
    section(8, 6 * sizes.index, () => [1, 1, 2, 3, 4, 7].forEach(index));
    int(54);
    (version < 3 ? int : long)(0);
    return Uint8Array.from(bytes);
  }

  test.each([1, 2, 3, 4].flatMap((version) => [true, false].map((isLittle) => [version, isLittle] as const)))(
    "version %d is read, low byte first: %s",
    async (version, isLittle) => {
      const read = await readMesh(oneElement(version, isLittle), { fileName: "a.meshb" });
      if (!read.success) throw new Error(read.errors[0].message);
      expect([...read.value.points]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
      expect([...read.value.tetrahedra]).toEqual([0, 1, 2, 3]);
      expect(read.value.regions.map(({ tag }) => tag)).toEqual([7]);
    },
  );

  test("a file cut anywhere is refused or read, but never crashes", async () => {
    const whole = oneElement(2, true);
    for (let length = 1; length < whole.length; length++) {
      const read = await readMesh(whole.slice(0, length), { fileName: "a.meshb" });
      if (!read.success) expect(read.errors[0].code).toMatch(/malformed-file|no-triangles/);
    }
    const [name, ...rest] = [...whole];
    const damaged = await readMesh(Uint8Array.from([(name ?? 0) + 1, ...rest]), { fileName: "a.meshb" });
    expect(damaged.success ? "" : damaged.errors[0].message).toMatch(/does not begin with the number 1/);
  });

  const python = process.env["TETRAFRONT_PYTHON"] ?? "python3";
  const { save, inFolder } = temporaryFolder();
  if (spawnSync(python, ["-c", "import meshio"]).status === 0) {
    test("meshio reads the same points and elements", async () => {
      const { bytesOf } = await written(block, "a.meshb");
      save("a.meshb", bytesOf.get("a.meshb") ?? new Uint8Array());
      const script =
        "import meshio, sys; m = meshio.read(sys.argv[1]); print(m.points.ravel().tolist(), [c.data.ravel().tolist() for c in m.cells], sep='\\n')";
      const { stdout, stderr } = spawnSync(python, ["-c", script, inFolder("a.meshb")], { encoding: "utf8" });
      const [points = "", cells = ""] = stdout.trim().split("\n");
      expect(JSON.parse(points || stderr)).toEqual([...block.points]);
      expect(JSON.parse(cells)).toEqual([[...block.triangles], [...block.tetrahedra]]);
    });
  }
});

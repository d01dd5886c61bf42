"""Runs other tetrahedral meshers on a closed surface, for comparison in `npm run bench speed` and `npm run bench parts`.

    peers.py                      prints the names of the peers whose packages can be imported
    peers.py NAME SURFACE.off     fills the surface with this peer and prints `name value` lines
    peers.py parts                prints the names of the peers that mesh parts and can be imported
    peers.py missing-parts        prints the packages of the others
    peers.py part NAME PART.stl   meshes the part with this peer's defaults, which may change the surface

To fill a surface, all peers get the same triangles, which they must keep, one thread, and sizes from the surface. Seconds are
processor time of the meshing call alone, without reading, passing and measuring the mesh.
"""

import sys
import time

import numpy


def read_off(path):
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    count, faces = int(words[1]), int(words[2])
    points = numpy.array(words[4 : 4 + 3 * count], dtype=float).reshape(-1, 3)
    rest = numpy.array(words[4 + 3 * count : 4 + 3 * count + 4 * faces], dtype=int).reshape(-1, 4)
    return points, rest[:, 1:]


def mean_edge(points, triangles):
    sides = points[triangles] - points[numpy.roll(triangles, 1, axis=1)]
    return float(numpy.linalg.norm(sides, axis=2).mean())


def timed(work):
    began = time.process_time()
    result = work()
    return result, time.process_time() - began


def netgen(points, triangles, **options):
    from netgen.meshing import Element2D, FaceDescriptor, Mesh, MeshPoint, Pnt

    mesh = Mesh(dim=3)
    nodes = [mesh.Add(MeshPoint(Pnt(*point))) for point in points.tolist()]
    patch = mesh.Add(FaceDescriptor(surfnr=1, domin=1, domout=0, bc=1))
    for triangle in triangles.tolist():
        mesh.Add(Element2D(patch, [nodes[node] for node in triangle]))
    size = mean_edge(points, triangles)
    _, seconds = timed(
        lambda: mesh.GenerateVolumeMesh(maxh=size, parallel_meshing=False, **options)
    )
    places = numpy.array([point.p for point in mesh.Points()])
    elements = numpy.array([[node.nr - 1 for node in element.vertices] for element in mesh.Elements3D()])
    return places, elements, seconds


def gmsh(points, triangles, algorithm, optimize):
    import gmsh as engine

    engine.initialize(interruptible=False)
    engine.option.setNumber("General.Terminal", 0)
    engine.option.setNumber("General.NumThreads", 1)
    engine.option.setNumber("Mesh.Algorithm3D", algorithm)
    engine.option.setNumber("Mesh.Optimize", optimize)
    surface = engine.model.addDiscreteEntity(2)
    names = numpy.arange(1, len(points) + 1)
    engine.model.mesh.addNodes(2, surface, names, points.ravel())
    engine.model.mesh.addElementsByType(surface, 2, [], (triangles + 1).ravel())
    engine.model.geo.addVolume([engine.model.geo.addSurfaceLoop([surface])])
    engine.model.geo.synchronize()
    _, seconds = timed(lambda: engine.model.mesh.generate(3))
    names, places, _ = engine.model.mesh.getNodes()
    positions = numpy.zeros(int(names.max()) + 1, dtype=int)
    positions[names.astype(int)] = numpy.arange(len(names))
    _, corners = engine.model.mesh.getElementsByType(4)
    elements = positions[corners.astype(int)].reshape(-1, 4)
    engine.finalize()
    return places.reshape(-1, 3), elements, seconds


def tetgen(points, triangles):
    from tetgen import TetGen

    mesher = TetGen(points, triangles.astype(numpy.int32))
    volume = mean_edge(points, triangles) ** 3 / (6 * 2**0.5)
    result, seconds = timed(lambda: mesher.tetrahedralize(switches=f"pYq1.2a{volume:.17g}Q"))
    return result[0], result[1], seconds


def read_stl(path):
    """Returns the points, each once, and the triangles of a binary STL file."""
    with open(path, "rb") as file:
        data = file.read()
    rows = numpy.frombuffer(
        data, offset=84, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]
    )
    points, numbers = numpy.unique(rows["corners"].reshape(-1, 3), axis=0, return_inverse=True)
    triangles = numpy.asarray(numbers).reshape(-1, 3)
    distinct = (triangles != numpy.roll(triangles, 1, axis=1)).all(axis=1)
    return points.astype(float), triangles[distinct]


def gmsh_part(path):
    import gmsh as engine

    engine.initialize(interruptible=False)
    engine.option.setNumber("General.Terminal", 0)
    engine.option.setNumber("General.NumThreads", 1)

    def work():
        engine.merge(path)
        mesh = engine.model.mesh
        mesh.classifySurfaces(numpy.radians(40), True, True, numpy.pi)
        mesh.createGeometry()
        surfaces = [tag for _, tag in engine.model.getEntities(2)]
        engine.model.geo.addVolume([engine.model.geo.addSurfaceLoop(surfaces)])
        engine.model.geo.synchronize()
        low, high = numpy.array(engine.model.getBoundingBox(-1, -1)).reshape(2, 3)
        engine.option.setNumber("Mesh.MeshSizeMax", numpy.linalg.norm(high - low) / 20)
        mesh.generate(3)

    _, seconds = timed(work)
    names, places, _ = engine.model.mesh.getNodes()
    positions = numpy.zeros(int(names.max()) + 1, dtype=int)
    positions[names.astype(int)] = numpy.arange(len(names))
    _, corners = engine.model.mesh.getElementsByType(4)
    engine.finalize()
    return places.reshape(-1, 3), positions[corners.astype(int)].reshape(-1, 4), seconds


def tetgen_part(path):
    from tetgen import TetGen

    points, triangles = read_stl(path)
    mesher = TetGen(points, triangles.astype(numpy.int32))
    result, seconds = timed(lambda: mesher.tetrahedralize(switches="pq1.2Q"))
    return result[0], result[1], seconds


def ftetwild_part(path):
    from pytetwild import tetrahedralize

    points, triangles = read_stl(path)
    result, seconds = timed(lambda: tetrahedralize(points, triangles.astype(numpy.int32), optimize=True))
    return numpy.asarray(result[0]), numpy.asarray(result[1]), seconds


PART_PEERS = {
    "Gmsh, classified and remeshed": ("gmsh", gmsh_part),
    "TetGen, quality": ("tetgen", tetgen_part),
    "fTetWild": ("pytetwild", ftetwild_part),
}

# Packages that a module needs besides its own.
NEEDED_TOO = {"pytetwild": ["pyvista"]}

DELAUNAY, FRONTAL, HXT = 1, 4, 10

PEERS = {
    "netgen-front": ("netgen", lambda *s: netgen(*s, delaunay=False, optsteps3d=0)),
    "netgen-front-optimized": ("netgen", lambda *s: netgen(*s, delaunay=False)),
    "netgen-default": ("netgen", lambda *s: netgen(*s, optsteps3d=0)),
    "netgen-default-optimized": ("netgen", netgen),
    "gmsh-delaunay": ("gmsh", lambda *s: gmsh(*s, DELAUNAY, 0)),
    "gmsh-delaunay-optimized": ("gmsh", lambda *s: gmsh(*s, DELAUNAY, 1)),
    "gmsh-frontal": ("gmsh", lambda *s: gmsh(*s, FRONTAL, 0)),
    "gmsh-hxt": ("gmsh", lambda *s: gmsh(*s, HXT, 0)),
    "gmsh-hxt-optimized": ("gmsh", lambda *s: gmsh(*s, HXT, 1)),
    "tetgen": ("tetgen", tetgen),
}


def dihedral_angles(points, elements):
    """Returns the six dihedral angles of each element, in degrees."""
    corners = points[elements]
    faces = [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)]
    normals = []
    for a, b, c in faces:
        normal = numpy.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a])
        normals.append(normal / numpy.linalg.norm(normal, axis=1)[:, None])
    angles = []
    for i in range(4):
        for j in range(i):
            cosines = -(normals[i] * normals[j]).sum(axis=1)
            angles.append(numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1))))
    return numpy.array(angles)


def radius_ratios(points, elements):
    """Returns 3 x inradius / circumradius of each element."""
    a, b, c, d = (points[elements[:, k]] for k in range(4))
    u, v, w = b - a, c - a, d - a
    vw, wu, uv = numpy.cross(v, w), numpy.cross(w, u), numpy.cross(u, v)
    six_volumes = numpy.abs((u * vw).sum(axis=1))
    areas = sum(numpy.linalg.norm(n, axis=1) for n in (vw, wu, uv, numpy.cross(c - b, d - b)))
    square = lambda x: (x * x).sum(axis=1)[:, None]
    to_centre = numpy.linalg.norm(square(u) * vw + square(v) * wu + square(w) * uv, axis=1)
    inradius = six_volumes / areas
    return 3 * inradius * 2 * six_volumes / numpy.maximum(to_centre, 1e-300)


def importable(module):
    try:
        __import__(module)
        return True
    except ImportError:
        return False


def print_missing(peers):
    for module, _ in peers.values():
        if not importable(module):
            print(" ".join([module, *NEEDED_TOO.get(module, [])]))
    return 0


def print_names(peers):
    for name, (module, _) in peers.items():
        if importable(module):
            print(name)
    return 0


def main(arguments):
    if not arguments:
        return print_names(PEERS)
    if arguments == ["parts"]:
        return print_names(PART_PEERS)
    if arguments == ["missing-parts"]:
        return print_missing(PART_PEERS)
    if arguments[0] == "part":
        points, elements, seconds = PART_PEERS[arguments[1]][1](arguments[2])
    else:
        name, path = arguments
        points, elements, seconds = PEERS[name][1](*read_off(path))
    if len(elements) == 0:
        print("no element", file=sys.stderr)
        return 1
    angles = dihedral_angles(points, elements)
    print(f"tetrahedra {len(elements)}")
    print(f"seconds {seconds:.6f}")
    print(f"minDihedral {angles.min():.4f}")
    print(f"maxDihedral {angles.max():.4f}")
    print(f"meanRadiusRatio {radius_ratios(points, elements).mean():.4f}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

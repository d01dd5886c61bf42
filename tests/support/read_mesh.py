"""Reads and writes mesh files by meshio (or gmsh). Prints one line of JSON per line of standard input:

read meshio KIND PATH / read gmsh PATH    what is in the file
second meshio KIND PATH / second gmsh - PATH   what the second-order elements of a file measure
values FROM TO                            the values of elements that Gmsh reads, which it writes again, as text
write FROM TO OPTIONS                     null, after meshio has read one file and written another

The fields are separated by tabs. A failure is printed as a text. Imports take longer than the work, so one process
answers all questions.
"""

import json
import sys


def by_meshio(kind, path):
    import meshio

    mesh = meshio.read(path, file_format=kind)
    tags = {}
    for name, blocks in mesh.cell_data.items():
        tags[name] = [block.reshape(-1).astype(int).tolist() if block.size == len(block) else [] for block in blocks]
    return {
        "points": mesh.points.tolist(),
        "cells": [[block.type, block.data.tolist()] for block in mesh.cells],
        "tags": tags,
        "names": {name: [int(data[0]), int(data[1])] for name, data in mesh.field_data.items()},
        "cellSets": {name: [len(block) if block is not None else 0 for block in blocks] for name, blocks in mesh.cell_sets.items()},
        "pointSets": {name: len(nodes) for name, nodes in mesh.point_sets.items()},
    }


def by_gmsh(path):
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    numbers, places, _ = gmsh.model.mesh.getNodes()
    place = {int(n): places[3 * i : 3 * i + 3].tolist() for i, n in enumerate(numbers)}

    def elements(dimension, entity):
        width = dimension + 1
        _, _, blocks = gmsh.model.mesh.getElements(dimension, entity)
        return [[int(n) - 1 for n in block[i : i + width]] for block in blocks for i in range(0, len(block), width)]

    entities = [[d, int(tag), elements(d, tag)] for d, tag in gmsh.model.getEntities() if d > 1]
    groups = []
    for dimension, tag in gmsh.model.getPhysicalGroups():
        parts = gmsh.model.getEntitiesForPhysicalGroup(dimension, tag)
        found = [nodes for entity in parts for nodes in elements(dimension, entity)]
        groups.append([dimension, int(tag), gmsh.model.getPhysicalName(dimension, tag), found])
    triangles = sum(len(block) for block in gmsh.model.mesh.getElements(2)[1])
    gmsh.finalize()
    return {"points": [place[n] for n in sorted(place)], "groups": groups, "entities": entities, "triangles": triangles}


def second_by_meshio(kind, path):
    """Volume by the quadratic shape functions, area by corners, and the largest distance of a node from its edge's middle."""
    import meshio
    import numpy as np

    mesh = meshio.read(path, file_format=kind)
    edges = {"tetra10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)], "triangle6": [(0, 1), (1, 2), (2, 0)]}
    # A rule of degree 3: Keast 1986.
    sixth, half = 1 / 6, 1 / 2
    rule = [(-2 / 15, [0.25] * 4)] + [(3 / 40, [half if j == i else sixth for j in range(4)]) for i in range(4)]
    found = {"volume": 0.0, "distance": 0.0, "elements": {}, "smallest": 1e300, "nodes": len(mesh.points)}
    for block in mesh.cells:
        if block.type not in edges:
            raise ValueError(f"unexpected {block.type}")
        found["elements"][block.type] = found["elements"].get(block.type, 0) + len(block.data)
        ends = edges[block.type]
        corners = len(ends) - 2 if len(ends) == 6 else 3
        for nodes in block.data:
            x = mesh.points[nodes]
            for e, (a, b) in enumerate(ends):
                distance = np.linalg.norm(x[corners + e] - (x[a] + x[b]) / 2)
                found["distance"] = max(found["distance"], float(distance))
            if block.type != "tetra10":
                continue
            volume = 0.0
            for weight, L in rule:
                # Derivatives by L1, L2, L3, with L0 = 1 - L1 - L2 - L3.
                by_l = np.zeros((10, 4))
                for i in range(4):
                    by_l[i, i] = 4 * L[i] - 1
                for e, (a, b) in enumerate(ends):
                    by_l[4 + e, a] = 4 * L[b]
                    by_l[4 + e, b] = 4 * L[a]
                jacobian = (by_l[:, 1:] - by_l[:, :1]).T @ x
                volume += weight * np.linalg.det(jacobian)
            found["volume"] += volume
            found["smallest"] = min(found["smallest"], volume)
    return found


def second_by_gmsh(_, path):
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    found = {"volume": 0.0, "smallest": 1e300, "types": [int(t) for t in gmsh.model.mesh.getElementTypes()]}
    rule, weights = gmsh.model.mesh.getIntegrationPoints(11, "Gauss4")
    for _, tag in gmsh.model.getEntities(3):
        _, determinants, _ = gmsh.model.mesh.getJacobians(11, rule, tag)
        for i in range(0, len(determinants), len(weights)):
            volume = float(sum(w * d for w, d in zip(weights, determinants[i : i + len(weights)])))
            found["volume"] += volume
            found["smallest"] = min(found["smallest"], volume)
    gmsh.finalize()
    return found


def values_by_gmsh(path, target):
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    (view,) = gmsh.view.getTags()
    _, tags, values, _, _ = gmsh.view.getModelData(view, 0)
    nodes = {}
    for dimension in (2, 3):
        _, blocks, corners = gmsh.model.mesh.getElements(dimension)
        for block, all_corners in zip(blocks, corners):
            for i, tag in enumerate(block):
                nodes[int(tag)] = [int(n) - 1 for n in all_corners[(dimension + 1) * i : (dimension + 1) * (i + 1)]]
    gmsh.option.setNumber("PostProcessing.Binary", 0)
    gmsh.view.write(view, target)
    gmsh.finalize()
    return [[nodes[int(tag)], float(value[0])] for tag, value in zip(tags, values)]


def answer_to(question, *fields):
    if question == "values":
        return values_by_gmsh(*fields)
    if question == "second":
        program, *rest = fields
        return second_by_gmsh(*rest) if program == "gmsh" else second_by_meshio(*rest)
    if question == "write":
        return write_by_meshio(*fields)
    program, *rest = fields
    return by_gmsh(*rest) if program == "gmsh" else by_meshio(*rest)


def write_by_meshio(source, target, options):
    import meshio

    mesh = meshio.read(source)
    mesh.cell_sets = {}
    meshio.write(target, mesh, **eval(options))


def main():
    if sys.argv[1] == "which":
        found = []
        for module in ("meshio", "gmsh"):
            try:
                __import__(module)
                found.append(module)
            except (ImportError, OSError):
                pass
        print(json.dumps(found))
        return
    answers = sys.stdout
    # meshio prints remarks on some formats.
    sys.stdout = sys.stderr
    for line in sys.stdin:
        try:
            answer = answer_to(*line.rstrip("\n").split("\t"))
        except Exception as failure:
            answer = f"{type(failure).__name__}: {failure}"
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()

"""Decides independently whether the ten-node tetrahedra of a file are valid: det J is positive everywhere.

    second_order.py FILE

prints {"elements", "valid", "invalid", "undecided", "least", "volume"}: `least` is the least scaled Jacobian, min det J / max
det J, of samples at the places of a fine lattice; `volume` is the integral of det J.

det J is a cubic polynomial. Its Bernstein coefficients are found by interpolation at the 20 places of a lattice, with the derivatives
of the shape functions. An element is valid if all coefficients are positive, invalid if a value is not; else it is divided
into eight.
"""

import itertools
import json
import sys
from math import factorial

import meshio
import numpy

# The edges of the middle nodes in VTK's order.
EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
MAX_DEPTH = 5


def lattice(degree):
    """Multi-indices (i, j, k, l) with the sum `degree`."""
    return numpy.array([m for m in itertools.product(range(degree + 1), repeat=4) if sum(m) == degree])


CUBIC = lattice(3)


def bernstein(places):
    weights = [6 / numpy.prod([factorial(i) for i in index]) for index in CUBIC]
    return numpy.stack([w * numpy.prod(places**index, axis=1) for w, index in zip(weights, CUBIC)], axis=1)


FROM_VALUES = numpy.linalg.inv(bernstein(CUBIC / 3))


def jacobians(nodes, places):
    """det J of all elements (n x 10 x 3) at all places (p x 4): n x p."""
    by_coordinate = numpy.zeros((len(places), 4, 10))
    for corner in range(4):
        by_coordinate[:, corner, corner] = 4 * places[:, corner] - 1
    for middle, (a, b) in enumerate(EDGES):
        by_coordinate[:, a, 4 + middle] = 4 * places[:, b]
        by_coordinate[:, b, 4 + middle] = 4 * places[:, a]
    derivatives = by_coordinate[:, 1:] - by_coordinate[:, :1]
    return numpy.linalg.det(numpy.einsum("pkn,enx->epkx", derivatives, nodes))


def eighths(corners):
    """Divides tetrahedra, four barycentric corners each, at the middles of their edges."""
    a, b, c, d = corners
    ab, ac, ad, bc, bd, cd = ((x + y) / 2 for x, y in itertools.combinations(corners, 2))
    parts = [(a, ab, ac, ad), (ab, b, bc, bd), (ac, bc, c, cd), (ad, bd, cd, d)]
    parts += [(ab, cd, ac, bc), (ab, cd, bc, bd), (ab, cd, bd, ad), (ab, cd, ad, ac)]
    return [numpy.array(part) for part in parts]


def verdict(nodes, corners, depth):
    """1 if det J of one element is positive on the part between four corners, -1 if it is not somewhere, 0 if undecided."""
    values = jacobians(nodes[None], CUBIC / 3 @ corners)[0]
    if (values <= 0).any():
        return -1
    # The corners of a part may be ordered so that nothing changes: det J is that of the whole element.
    if (FROM_VALUES @ values > 1e-12 * values.max()).all():
        return 1
    if depth == MAX_DEPTH:
        return 0
    found = 1
    for part in eighths(corners):
        own = verdict(nodes, part, depth + 1)
        if own < 0:
            return -1
        found = min(found, own)
    return found


def main(file_name):
    mesh = meshio.read(file_name)
    cells = numpy.concatenate([block.data for block in mesh.cells if block.type == "tetra10"])
    nodes = mesh.points[cells]
    verdicts = numpy.array([verdict(element, numpy.eye(4), 0) for element in nodes])
    samples = jacobians(nodes, lattice(8) / 8)
    coefficients = jacobians(nodes, CUBIC / 3) @ FROM_VALUES.T
    print(
        json.dumps(
            {
                "elements": len(cells),
                "valid": int((verdicts > 0).sum()),
                "invalid": int((verdicts < 0).sum()),
                "undecided": int((verdicts == 0).sum()),
                "least": float((samples.min(axis=1) / samples.max(axis=1)).min()),
                "volume": float(coefficients.mean(axis=1).sum() / 6),
            }
        )
    )


main(sys.argv[1])

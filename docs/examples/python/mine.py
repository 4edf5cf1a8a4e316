"""A little rasterizer that is right: triangles in front of the eye by the rules of Vulkan, one
sample per pixel, smooth attributes. It computes in fractions and rounds once, at the end."""

from fractions import Fraction

import numpy


def draw(case):
    """A picture of the case, with a channel for each attribute; without any, of what is covered."""
    size = case.framebuffer
    channels = max(1, len(case.attributes))
    picture = numpy.zeros((size.height, size.width, channels), numpy.float32)
    for corners in case.triangles:
        draw_triangle([case.vertices[corner] for corner in corners], picture)
    return picture


def draw_triangle(vertices, picture):
    height, width, _ = picture.shape
    w = [Fraction(vertex.position[3]) for vertex in vertices]
    u = [(Fraction(v.position[0]) / v_w + 1) * width / 2 for v, v_w in zip(vertices, w)]
    v = [(Fraction(v.position[1]) / v_w + 1) * height / 2 for v, v_w in zip(vertices, w)]
    edges = [edge(u, v, i) for i in range(3)]
    area = at(edges[0], u[0], v[0])
    if area == 0:
        return
    if area < 0:
        edges = [(-a, -b, -c) for a, b, c in edges]
    for y in range(height):
        for x in range(width):
            inside = [at(one, x + Fraction(1, 2), y + Fraction(1, 2)) for one in edges]
            if all(e > 0 or (e == 0 and owns_ties(*one)) for e, one in zip(inside, edges)):
                picture[y, x] = shade(vertices, w, inside)


def edge(u, v, i):
    """The function a u + b v + c of the edge opposite vertex i."""
    j, k = (i + 1) % 3, (i + 2) % 3
    a, b = v[j] - v[k], u[k] - u[j]
    return a, b, -(a * u[j] + b * v[j])


def at(one, u, v):
    a, b, c = one
    return a * u + b * v + c


def owns_ties(a, b, _):
    """Whether samples exactly on this edge are inside: on left edges, and on top ones."""
    return a > 0 or (a == 0 and b > 0)


def shade(vertices, w, inside):
    if not vertices[0].attributes:
        return [1]
    weights = [e / w_i for e, w_i in zip(inside, w)]  # perspective
    values = []
    for r in zip(*(vertex.attributes for vertex in vertices)):
        total = sum(Fraction(r_i) * weight for r_i, weight in zip(r, weights))
        values.append(float(total / sum(weights)))
    return values

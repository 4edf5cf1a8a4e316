"""A tiny rasterizer that gives only an 8-bit image. Put yours in its place."""

GRID = 256  # points per pixel and axis


def draw_image(triangles, width, height):
    """Returns an image of width × height × 4 bytes, RGBA, row 0 at the top, 0 where nothing is.

    A triangle is three vertices, each ((x, y, z, w), (red, green, blue)) with clip coordinates,
    w > 0, 0 <= z <= w, and colours from 0 to 1. x/w and y/w of -1 to 1 map to width and height,
    y = -1 to the top. A pixel's sample is its centre. The triangle of least z/w is seen, the first
    of equals, from both sides; the depth buffer begins so far away that z/w = 1 is drawn. Triangles
    may reach beyond the image's sides. Colours are interpolated with perspective, without lighting,
    blending, dithering or gamma, and rounded to bytes: 1 becomes 255. Alpha is ignored.
    """
    image = bytearray(4 * width * height)
    depths = [float("inf")] * (width * height)
    for triangle in triangles:
        draw_triangle(triangle, width, height, depths, image)
    return image


def draw_triangle(triangle, width, height, depths, image):
    positions = [position for position, _ in triangle]
    x = [round((p[0] / p[3] + 1) / 2 * width * GRID) for p in positions]
    y = [round((p[1] / p[3] + 1) / 2 * height * GRID) for p in positions]
    edges = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        edges.append((y[j] - y[k], x[k] - x[j], x[j] * y[k] - x[k] * y[j]))
    area = sum(edge[2] for edge in edges)
    if area == 0:
        return
    if area < 0:
        edges = [(-a, -b, -c) for a, b, c in edges]
    for row in range(max(min(y) // GRID, 0), min(max(y) // GRID + 1, height)):
        for column in range(max(min(x) // GRID, 0), min(max(x) // GRID + 1, width)):
            u, v = column * GRID + GRID // 2, row * GRID + GRID // 2
            weights = [a * u + b * v + c for a, b, c in edges]
            # Of samples on an edge, those of left and of horizontal top edges are inside.
            if all(
                w > 0 or (w == 0 and (a > 0 or (a == 0 and b > 0)))
                for w, (a, b, _) in zip(weights, edges)
            ):
                at = row * width + column
                draw_pixel(triangle, [w / abs(area) for w in weights], at, depths, image)


def draw_pixel(triangle, weights, at, depths, image):
    depth = sum(weight * (p[2] / p[3]) for weight, (p, _) in zip(weights, triangle))
    if not depth < depths[at]:
        return
    depths[at] = depth
    weights = [weight / p[3] for weight, (p, _) in zip(weights, triangle)]  # perspective
    for channel in range(3):
        color = sum(weight * c[channel] for weight, (_, c) in zip(weights, triangle))
        image[4 * at + channel] = int(color / sum(weights) * 255 + 0.5)
    image[4 * at + 3] = 255

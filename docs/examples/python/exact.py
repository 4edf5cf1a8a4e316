from rastercheck import Attribute, Case, Framebuffer, Vertex, Viewport, oracle

size = Framebuffer(4, 2)
case = Case(
    size,
    Viewport.of(size),
    "vulkan",
    [
        Vertex((-1, -1, 0, 1), [0]),
        Vertex((1, -1, 0, 1), [1]),
        Vertex((-3, 3, 0, 3), [2]),
    ],
    [(0, 1, 2)],
    attributes=[Attribute("u")],
)
for fragment in oracle(case):
    u = fragment.attributes[0]
    print(fragment.x, fragment.y, fragment.verdict, fragment.reason, u.exact, float(u))

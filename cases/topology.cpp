#include "cases/topology.h"

namespace rastercheck::cases {

std::vector<Triangle> triangles_of(Topology topology, std::uint32_t count, Rules rules) {
  const bool is_last_provoking = rules == Rules::opengl;
  const std::uint32_t step = topology == Topology::triangles ? 3 : 1;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i + 2 < count; i += step) {
    if (topology == Topology::fan) {
      triangles.push_back(is_last_provoking ? Triangle{0, i + 1, i + 2}
                                            : Triangle{i + 1, i + 2, 0});
    } else if (topology == Topology::strip && i % 2 == 1) {
      triangles.push_back(is_last_provoking ? Triangle{i + 1, i, i + 2}
                                            : Triangle{i, i + 2, i + 1});
    } else {
      triangles.push_back({i, i + 1, i + 2});
    }
  }
  return triangles;
}

}  // namespace rastercheck::cases

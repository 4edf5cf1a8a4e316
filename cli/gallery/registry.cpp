#include <algorithm>
#include <vector>

#include "cli/gallery/figure.h"

namespace rastercheck::gallery {
namespace {

std::vector<Figure>& registry() {
  static std::vector<Figure> all;
  return all;
}

}  // namespace

std::span<const Figure> figures() { return registry(); }

FigureRegistration::FigureRegistration(const Figure& figure) {
  // Files register in the linker's order; the page shows figures by name.
  const auto after =
      std::find_if(registry().begin(), registry().end(),
                   [&figure](const Figure& other) { return other.name > figure.name; });
  registry().insert(after, figure);
}

}  // namespace rastercheck::gallery

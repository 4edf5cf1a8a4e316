#include "properties/laws/internal/primitive_promise.h"

#include <algorithm>

namespace rastercheck::properties {
namespace {

bool draws(backends::Backend& backend, cases::Primitive primitive) {
  const std::vector<cases::Primitive> all = backend.about().capabilities.primitives;
  return std::find(all.begin(), all.end(), primitive) != all.end();
}

}  // namespace

bool draws_lines(backends::Backend& backend) { return draws(backend, cases::Primitive::lines); }
bool draws_points(backends::Backend& backend) { return draws(backend, cases::Primitive::points); }

}  // namespace rastercheck::properties

#include <algorithm>
#include <vector>

#include "rasterizer/internal/checked_draw.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

/// Sorted by name. A function's static, so that it is there before the first registration whatever
/// the order in which files are initialised.
std::vector<Method>& registered() {
  static std::vector<Method> methods;
  return methods;
}

bool name_less(const Method& a, const Method& b) { return a.name < b.name; }

}  // namespace

MethodRegistration::MethodRegistration(const Method& method) {
  std::vector<Method>& all = registered();
  all.insert(std::upper_bound(all.begin(), all.end(), method, name_less), method);
}

std::span<const Method> methods() { return registered(); }

const Method* find_method(std::string_view name) {
  const auto found = std::find_if(registered().begin(), registered().end(),
                                  [name](const Method& method) { return method.name == name; });
  return found == registered().end() ? nullptr : &*found;
}

DrawResult draw_fragments_by(std::string_view method, const State& state, const Mesh& mesh,
                             const TargetSize& size, Fragments& fragments) {
  const Method* found = find_method(method);
  if (found == nullptr) return {Error::unknown_method, {}};
  return draw_checked(found->draw, state, mesh, size, fragments);
}

}  // namespace rastercheck::rasterizer

#include <algorithm>
#include <vector>

#include "rasterizer/internal/checked_draw.h"
#include "rasterizer/methods/internal/method_tap.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

/// All methods, sorted by name. A static variable of a function, so that it exists before the first
/// registration, whatever the order in which files are initialised.
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
  const auto draw = [found](const State& s, const Mesh& m, const TargetSize& t, Fragments& f) {
    return found->draw(s, m, t, f, nullptr);
  };
  return draw_checked(draw, state, mesh, size, fragments);
}

TraceResult trace_sample_by(std::string_view method, const State& state, const Mesh& mesh,
                            const TargetSize& size, const SamplePlace& address) {
  const Method* found = find_method(method);
  if (found == nullptr) return {Error::unknown_method, std::nullopt};
  const auto trace = [found](const State& s, const Mesh& m, const TargetSize& t,
                             const SamplePlace& a) {
    // Draws all of the mesh, because how a method draws one triangle may depend on its promise for
    // all triangles.
    MethodTap tap(a);
    Fragments fragments;
    found->draw(s, m, t, fragments, &tap);
    return tap.trace;
  };
  return trace_checked(trace, state, mesh, size, address);
}

}  // namespace rastercheck::rasterizer

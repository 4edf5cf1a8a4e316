#pragma once

// The textbook methods, one file each. A file in rasterizer/methods/ defines one and registers it:
//
//   const MethodRegistration kRegistration({"name", "seed and section", &draw});

#include <span>
#include <string_view>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Appends the fragments of every triangle, as if each were drawn alone. The arguments were
/// checked.
using DrawFragments = DrawCounts (*)(const State& state, const Mesh& mesh, const TargetSize& size,
                                     Fragments& fragments);

struct Method {
  std::string_view name;    ///< as in `method:NAME`
  std::string_view source;  ///< the text it comes from: seed and section
  DrawFragments draw;
};

/// All methods, in the order of their names.
std::span<const Method> methods();

/// draw_fragments by a textbook method; Error::unknown_method where there is none of that name.
DrawResult draw_fragments_by(std::string_view method, const State& state, const Mesh& mesh,
                             const TargetSize& size, Fragments& fragments);

struct MethodRegistration {
  explicit MethodRegistration(const Method& method);
};

}  // namespace rastercheck::rasterizer

#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace rastercheck::records {

/// What became of a scene that was asked for, on one backend: how much of it was judged.
struct SceneResult {
  std::string file;             ///< the scene's name
  std::string backend;          ///< specification
  std::uint64_t triangles = 0;  ///< of the scene
  std::uint64_t fragments = 0;  ///< drawn
  /// Counts samples of a triangle, drawn or missing, of which the contract leaves nothing open:
  /// neither whether they are drawn nor any of their values.
  std::uint64_t judged = 0;
  /// Counts the other fragments that were drawn: their coverage is open, or one of their values.
  std::uint64_t open = 0;
  /// Counts the judged samples that are missing or too much, or have a wrong value, as far as laws
  /// ask.
  std::uint64_t wrong = 0;
  bool is_known = false;  ///< all that is wrong is known of the driver
  /// Triangles of which nothing was judged, by why.
  std::map<std::string, std::uint64_t> not_judged = {};
  std::uint64_t values = 0;  ///< judged
  /// Fragments and values that were drawn and not judged, by why.
  std::map<std::string, std::uint64_t> values_not_judged = {};
  bool operator==(const SceneResult&) const = default;
};

/// One sentence for people, such as "Scene bunny.obj on cpu: 69666 triangles, 51234 fragments;
/// 51234 samples judged, all right."; where nothing was judged, it says why.
std::string scene_sentence(const SceneResult& scene);

}  // namespace rastercheck::records

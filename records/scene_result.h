#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace rastercheck::records {

/// The result of a scene on one backend, and how much of the scene was judged.
struct SceneResult {
  std::string file;             ///< the scene's name
  std::string backend;          ///< specification
  std::uint64_t triangles = 0;  ///< the scene's triangles
  std::uint64_t fragments = 0;  ///< drawn fragments
  /// Samples of a triangle, drawn or missing, for which the contract leaves open neither coverage
  /// nor any value.
  std::uint64_t judged = 0;
  /// All other drawn fragments: their coverage or one of their values is open.
  std::uint64_t open = 0;
  /// Judged samples that are missing, extra or have a wrong value, as far as the laws check.
  std::uint64_t wrong = 0;
  bool is_known = false;  ///< true if every fault is a known defect of the driver
  /// Triangles without any judged sample, by reason.
  std::map<std::string, std::uint64_t> not_judged = {};
  std::uint64_t values = 0;  ///< judged values
  /// Fragments and values drawn but not judged, by reason.
  std::map<std::string, std::uint64_t> values_not_judged = {};
  bool operator==(const SceneResult&) const = default;
};

/// One sentence for people, such as "Scene bunny.obj on cpu: 69666 triangles, 51234 fragments;
/// 51234 samples judged, all correct."; gives the reason if nothing was judged.
std::string scene_sentence(const SceneResult& scene);

}  // namespace rastercheck::records

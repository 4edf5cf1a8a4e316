#pragma once

// Shaders that draw a case and record each fragment, for tests that are handed on: a vertex shader
// that passes everything through, and a fragment shader that writes to a buffer instead of to a
// target, so that values need no format and a sample that is drawn twice shows.
//
// A vertex has vectors of four numbers: the position, the attributes in fours, the clip distances
// in fours. The buffer has kRecordHead + attributes words for each sample of a rectangle of pixels,
// by y, x and sample: how often it was drawn, the depth, the attributes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cases/case.h"

namespace rastercheck::reports {

/// `vulkan_floats`: for Vulkan, with float32 words and the numbers of fragments in a buffer of
/// their own, one for each record; a fragment with a NaN counts as a hundred there, because not
/// every test can tell NaN from a number.
enum class ShaderApi { opengl, vulkan, vulkan_floats };

/// The first words of a sample's record: the number of fragments, the depth.
inline constexpr std::size_t kRecordHead = 2;

/// The pixels whose fragments are recorded.
struct RecordedPart {
  std::uint32_t left = 0;
  std::uint32_t top = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// The number of vectors for the attributes of a vertex, and for its clip distances.
std::size_t attribute_vectors(const cases::Case& c);
std::size_t clip_vectors(const cases::Case& c);
/// The numbers of a vertex: four for each vector, 0 after the last attribute, 1 (inside) after the
/// last clip distance.
std::vector<float> vertex_numbers(const cases::Case& c, std::size_t vertex);

std::string vertex_shader(const cases::Case& c, ShaderApi api);
std::string fragment_shader(const cases::Case& c, const RecordedPart& part, ShaderApi api);

/// The words of one sample's record, and the first word of a sample's.
std::size_t record_size(const cases::Case& c);
std::size_t record_at(const cases::Case& c, const RecordedPart& part, std::uint32_t x,
                      std::uint32_t y, std::uint32_t sample);

/// True if the recorded depth is the sample's: with several samples it may be that of another point
/// of the pixel. Nor is it what a depth buffer stores if the case clamps depths.
bool records_depth(const cases::Case& c);

}  // namespace rastercheck::reports

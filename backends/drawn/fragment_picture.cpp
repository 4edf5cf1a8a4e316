#include "backends/drawn/fragment_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cases/fragment_collector.h"

namespace rastercheck::backends {
namespace {

/// Returns the indices in the file of the channels triangle, depth, value0, value1…; stops at the
/// first channel that is missing.
std::vector<std::size_t> channels_of(const cases::PictureFile& picture, std::size_t attributes) {
  std::vector<std::string> names{"triangle", "depth"};
  for (std::size_t k = 0; k < attributes; ++k) names.push_back(fmt::format("value{}", k));
  const std::vector<std::string>& all = picture.channels;
  const bool is_named = std::find(all.begin(), all.end(), names[0]) != all.end();
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size() && i < all.size(); ++i) {
    const auto at = is_named ? std::find(all.begin(), all.end(), names[i])
                             : all.begin() + static_cast<std::ptrdiff_t>(i);
    if (at == all.end()) break;
    found.push_back(static_cast<std::size_t>(at - all.begin()));
  }
  return found;
}

/// Returns the number as an integer: 0, or a triangle's index plus 1. Returns -1 if it is neither.
std::int64_t triangle_of(float number, std::size_t triangles) {
  const bool is_in_range = number >= 0 && number <= static_cast<float>(triangles);  // false for NaN
  if (!is_in_range) return -1;
  const auto index = static_cast<std::int64_t>(number);
  return static_cast<float>(index) == number ? index : -1;
}

}  // namespace

Result<cases::Fragments> fragments_of_picture(const cases::PictureFile& picture,
                                              const std::string& file, const cases::Case& c) {
  const auto fail = [&file](const std::string& reason, Failure failure = Failure::refused) {
    return tl::unexpected(Error{file, "", reason, failure});
  };
  if (c.triangles.size() > 1 && c.depth_test == cases::DepthTest::none) {
    return fail("a picture cannot hold several triangles without a depth test",
                Failure::unsupported);
  }
  const auto samples = static_cast<std::uint32_t>(c.framebuffer.samples);
  const int columns = c.framebuffer.width * c.framebuffer.samples;
  if (picture.width != columns || picture.height != c.framebuffer.height) {
    return fail(fmt::format("is {} x {}; the case has {} columns of samples and {} rows",
                            picture.width, picture.height, columns, c.framebuffer.height));
  }
  const std::size_t attributes = c.attributes.size();
  const std::vector<std::size_t> channels = channels_of(picture, attributes);
  if (picture.channels.size() != attributes + 2 || channels.size() != attributes + 2) {
    return fail(fmt::format("must have {} channels: triangle, depth and {} values", attributes + 2,
                            attributes));
  }
  for (const std::size_t channel : channels) {
    if (picture.stored[channel] != cases::Storage::float32)
      return fail("must store float32 numbers");
  }
  cases::FragmentCollector collector(c);
  std::vector<float> values(attributes);
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float* const pixel = picture.pixel(column, row);
      const std::int64_t shown = triangle_of(pixel[channels[0]], c.triangles.size());
      if (shown < 0) {
        return fail(fmt::format("row {}, column {}: {} is not the index of a triangle plus 1", row,
                                column, pixel[channels[0]]));
      }
      if (shown == 0) continue;
      for (std::size_t k = 0; k < attributes; ++k) values[k] = pixel[channels[k + 2]];
      const auto place = static_cast<std::uint32_t>(column);
      collector.add({static_cast<std::uint32_t>(shown - 1), static_cast<std::uint32_t>(row),
                     place / samples, place % samples},
                    pixel[channels[1]], values);
    }
  }
  tl::expected<cases::Fragments, std::string> drawn = collector.take();
  if (!drawn) return fail(drawn.error());
  return *std::move(drawn);
}

}  // namespace rastercheck::backends

#include "backends/drawn/drawn_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "backends/plugin/plugin.h"
#include "cases/fragment_collector.h"
#include "cases/json.h"

namespace rastercheck::backends {
namespace {

constexpr std::string_view kMagic = "RCDRAWN1";

/// Reads the words of a file in their order.
class Words {
 public:
  explicit Words(std::string_view bytes) : bytes_(bytes) {}

  /// The number of words that are left.
  std::size_t left() const { return (bytes_.size() - at_) / 4; }
  std::size_t place() const { return at_; }
  bool is_at_end() const { return at_ == bytes_.size(); }
  /// Requires left() > 0.
  std::uint32_t next() {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes_.data() + at_, sizeof word);
    at_ += sizeof word;
    return word;
  }
  /// The bytes of `count` words; requires left() >= count.
  std::string_view take(std::size_t count) {
    const std::string_view taken = bytes_.substr(at_, count * 4);
    at_ += count * 4;
    return taken;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

std::uint32_t word_of(std::string_view array, std::size_t index) {
  std::uint32_t word = 0;
  std::memcpy(&word, array.data() + index * 4, sizeof word);
  return word;
}

/// The pixels [min_x, max_x) × [min_y, max_y).
struct Part {
  std::uint32_t min_x = 0;
  std::uint32_t min_y = 0;
  std::uint32_t max_x = 0;
  std::uint32_t max_y = 0;
};

class DrawnReader {
 public:
  DrawnReader(std::string_view bytes, const std::string& file, const cases::Case& c)
      : words_(bytes.substr(kMagic.size())), file_(file), case_(c), fragments_(c) {}

  Result<cases::Fragments> read() {
    const auto triangles = static_cast<std::uint32_t>(case_.triangles.size());
    const bool is_together = case_.depth_test != cases::DepthTest::none;
    const std::uint32_t draws = is_together ? std::min(triangles, 1U) : triangles;
    if (words_.left() < 1) return cut_short();
    if (const std::uint32_t told = words_.next(); told != draws) {
      return fail(fmt::format("has {} draws; the case has {}", told, draws));
    }
    for (std::uint32_t i = 0; i < draws; ++i) {
      const Result<void> read = read_draw(i, is_together ? triangles : 1);
      if (!read) return tl::unexpected(read.error());
    }
    if (!words_.is_at_end()) return fail("has bytes after the last draw");
    tl::expected<cases::Fragments, std::string> drawn = fragments_.take();
    if (!drawn) return fail(drawn.error());
    return *std::move(drawn);
  }

 private:
  Result<void> read_draw(std::uint32_t first, std::uint32_t triangles) {
    if (words_.left() < 6) return cut_short();
    const std::uint32_t status = words_.next();
    Part part;
    for (std::uint32_t* side : {&part.min_x, &part.min_y, &part.max_x, &part.max_y}) {
      *side = words_.next();
    }
    const std::size_t length = words_.next();
    const std::size_t padded = (length + 3) / 4;
    if (words_.left() < padded) return cut_short();
    const std::string message(words_.take(padded).substr(0, length));
    if (status == RASTERCHECK_OK) return read_samples(part, first, triangles);
    if (status != RASTERCHECK_UNSUPPORTED && status != RASTERCHECK_FAILED) {
      return fail(fmt::format("draw {} has the unknown status {}", first, status));
    }
    return fail(fmt::format("draw {} was not drawn: {}", first, cases::printable(message)),
                status == RASTERCHECK_UNSUPPORTED ? Failure::unsupported : Failure::refused);
  }

  Result<void> read_samples(const Part& part, std::uint32_t first, std::uint32_t triangles) {
    const auto width = static_cast<std::uint32_t>(case_.framebuffer.width);
    const auto height = static_cast<std::uint32_t>(case_.framebuffer.height);
    if (part.min_x > part.max_x || part.min_y > part.max_y || part.max_x > width ||
        part.max_y > height) {
      return fail(
          fmt::format("draw {} covers an invalid rectangle: x from {} to {}, y from {} to "
                      "{}, of {} x {} pixels",
                      first, part.min_x, part.max_x, part.min_y, part.max_y, width, height));
    }
    const auto per_pixel = static_cast<std::size_t>(case_.framebuffer.samples);
    const std::size_t columns = (part.max_x - part.min_x) * per_pixel;
    const std::size_t count = columns * (part.max_y - part.min_y);
    const std::size_t attributes = case_.attributes.size();
    if (words_.left() / (2 + attributes) < count) return cut_short();
    const std::string_view shown = words_.take(count);
    const std::string_view depth = words_.take(count);
    const std::string_view values = words_.take(count * attributes);
    std::vector<float> own(attributes);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t index = word_of(shown, i);
      if (index == 0) continue;
      if (index > triangles) {
        return fail(fmt::format("draw {} shows triangle {} of {}", first, index - 1, triangles));
      }
      cases::SamplePlace at;
      at.triangle = first + index - 1;
      at.y = part.min_y + static_cast<std::uint32_t>(i / columns);
      at.x = part.min_x + static_cast<std::uint32_t>(i % columns / per_pixel);
      at.sample = static_cast<std::uint32_t>(i % per_pixel);
      for (std::size_t k = 0; k < attributes; ++k) {
        own[k] = std::bit_cast<float>(word_of(values, i * attributes + k));
      }
      fragments_.add(at, std::bit_cast<float>(word_of(depth, i)), own);
    }
    return {};
  }

  tl::unexpected<Error> cut_short() const {
    return fail(
        fmt::format("ends too early, in what begins at byte {}", words_.place() + kMagic.size()));
  }
  tl::unexpected<Error> fail(const std::string& reason, Failure failure = Failure::refused) const {
    return tl::unexpected(Error{file_, "", reason, failure});
  }

  Words words_;
  const std::string& file_;
  const cases::Case& case_;
  cases::FragmentCollector fragments_;
};

}  // namespace

Result<cases::Fragments> parse_drawn(std::string_view bytes, const std::string& file,
                                     const cases::Case& c) {
  if (!bytes.starts_with(kMagic)) {
    return tl::unexpected(Error{file, "", "does not begin with RCDRAWN1"});
  }
  return DrawnReader(bytes, file, c).read();
}

}  // namespace rastercheck::backends

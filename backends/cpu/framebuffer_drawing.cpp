#include "backends/cpu/framebuffer_drawing.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "backends/cpu/case_state.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// Farther than any fragment.
constexpr float kFarthest = std::numeric_limits<float>::infinity();
/// The depth of no fragment; those outside their triangle may have infinite depths.
constexpr float kUntouched = std::numeric_limits<float>::quiet_NaN();

/// A shader that writes the number of a sample's triangle, which must fit into a float32.
struct TriangleNumber {
  static constexpr std::size_t kMost = std::size_t{1} << 24;

  std::size_t outputs() const { return 1; }
  bool discards() const { return false; }
  void operator()(const ras::FragmentBatch& in, ras::ShadedBatch& out) const {
    for (std::size_t lane = 0; lane < in.lanes; ++lane) {
      const auto triangle = in.cells[lane / ras::FragmentBatch::kCellLanes].triangle;
      out.color[0][lane] = static_cast<float>(triangle);
    }
  }
};

class FramebufferDrawing {
 public:
  FramebufferDrawing(const cases::Case& c, ras::Conservative conservative, unsigned threads)
      : case_(c),
        state_(state_of(c, conservative)),
        memory_(c),
        threads_(threads),
        clear_depth_(is_tested() ? stored_clear(c).value_or(kFarthest) : kUntouched) {
    result_.attribute_count = c.attributes.size();
  }

  Result<cases::Fragments> draw() {
    if (is_tested() && case_.triangles.size() > TriangleNumber::kMost) {
      return tl::unexpected(
          Error{"", "", "too many triangles: their indices do not fit into a float32"});
    }
    const std::size_t attributes = case_.attributes.size();
    auto error = ras::clear(framebuffer_, target_size(case_), attributes, clear_depth_);
    if (!error) error = is_tested() ? draw_all() : draw_each();
    if (error) return tl::unexpected(refused(*error));
    return std::move(result_);
  }

 private:
  bool is_tested() const { return case_.depth_test == cases::DepthTest::less; }

  /// Draws all triangles into one framebuffer and their numbers into another.
  std::optional<ras::Error> draw_all() {
    state_.depth_test = ras::DepthTest::less;
    const ras::Mesh mesh = memory_.mesh();
    if (const auto error = draw(mesh)) return error;
    const ras::TargetSize size = target_size(case_);
    ras::Picture numbers;
    const auto error =
        clear_and_draw(state_, mesh, TriangleNumber(), size, clear_depth_, numbers, threads_).error;
    if (error) return error;
    take([&](std::size_t at) { return static_cast<std::uint32_t>(numbers.attributes[at]); });
    return std::nullopt;
  }

  std::optional<ras::Error> draw_each() {
    const ras::Mesh mesh = memory_.mesh();
    ras::Mesh drawn = mesh;
    // First draws a mesh without triangles, so that mismatched arrays are refused even if the case
    // has no triangle.
    drawn.triangles = {};
    if (const auto error = draw(drawn)) return error;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      drawn.triangles = mesh.triangles.subspan(t, 1);
      if (const auto error = draw(drawn)) return error;
      take([t](std::size_t) { return t; });
    }
    return std::nullopt;
  }

  std::optional<ras::Error> draw(const ras::Mesh& mesh) {
    return ras::draw(state_, mesh, framebuffer_, threads_).error;
  }

  /// Lists the samples that were drawn and clears them.
  template <typename TriangleOf>
  void take(const TriangleOf& triangle_of) {
    const auto samples = static_cast<std::size_t>(case_.framebuffer.samples);
    const auto width = static_cast<std::size_t>(case_.framebuffer.width);
    const std::size_t attributes = case_.attributes.size();
    for (std::size_t at = 0; at < framebuffer_.depth.size(); ++at) {
      // Only a nearer fragment passes the depth test and changes the depth; without a test, all do.
      const float depth = framebuffer_.depth[at];
      if (is_tested() ? depth == clear_depth_ : std::isnan(depth)) continue;
      result_.triangle.push_back(triangle_of(at));
      result_.x.push_back(static_cast<std::uint16_t>(at / samples % width));
      result_.y.push_back(static_cast<std::uint16_t>(at / samples / width));
      result_.sample.push_back(static_cast<std::uint8_t>(at % samples));
      result_.depth.push_back(framebuffer_.depth[at]);
      framebuffer_.depth[at] = clear_depth_;
      const auto values =
          framebuffer_.attributes.begin() + static_cast<std::ptrdiff_t>(at * attributes);
      result_.attributes.insert(result_.attributes.end(), values,
                                values + static_cast<std::ptrdiff_t>(attributes));
    }
  }

  const cases::Case& case_;
  ras::State state_;
  CaseMesh memory_;
  unsigned threads_;
  float clear_depth_;
  ras::Picture framebuffer_;
  cases::Fragments result_;
};

}  // namespace

Result<cases::Fragments> draw_through_framebuffer(const cases::Case& c,
                                                  ras::Conservative conservative,
                                                  unsigned threads) {
  return FramebufferDrawing(c, conservative, threads).draw();
}

}  // namespace rastercheck::backends

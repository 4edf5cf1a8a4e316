// The backend `plugin:PATH.so`, a rasterizer in a shared library (plugin.h).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "backends/factory.h"
#include "backends/plugin/draw_state.h"
#include "backends/plugin/foreign_call.h"
#include "backends/plugin/guarded_array.h"
#include "backends/plugin/library.h"
#include "backends/plugin/occlusion_query.h"
#include "backends/plugin/picture_drawing.h"

namespace rastercheck::backends::plugin_registration {
namespace {

/// Framebuffers with at most this many samples are cleared, and searched for misplaced coverage, as
/// a whole for each draw. In larger framebuffers, both steps cover only the rectangle that the
/// plugin reports.
constexpr std::size_t kSearchedWhole = std::size_t{1} << 16U;

template <typename T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

/// A plugin's arrays, with the names that messages about wrong accesses use.
struct Arrays {
  GuardedArray sample_positions{"draw->sample_positions"};
  GuardedArray positions{"draw->positions"};
  GuardedArray attributes{"draw->attributes"};
  GuardedArray attribute_values{"draw->attribute_values"};
  GuardedArray clip_distances{"draw->clip_distances"};
  GuardedArray indices{"draw->indices"};
  GuardedArray coverage{"output->coverage"};
  GuardedArray triangle{"output->triangle"};
  GuardedArray depth{"output->depth"};
  GuardedArray values{"output->attributes"};
  GuardedArray message{"output->message"};
};

/// The pixels [min_x, max_x) × [min_y, max_y).
struct Rectangle {
  std::uint32_t min_x = 0;
  std::uint32_t min_y = 0;
  std::uint32_t max_x = 0;
  std::uint32_t max_y = 0;
};

class PluginBackend : public Backend, private OcclusionCuller, private PictureDrawer {
 public:
  PluginBackend(std::string path, Plugin plugin)
      : path_(std::move(path)), plugin_(std::move(plugin)), query_(path_), picture_(path_) {}

  About about() const override {
    // has_limits is set because the plugin may answer any draw with RASTERCHECK_UNSUPPORTED.
    return {.description = describe(plugin_),
            .has_limits = true,
            .capabilities = capabilities_of(plugin_.contract),
            .answers_occlusion_queries = plugin_.query != nullptr,
            .draws_pictures = plugin_.draw_picture != nullptr};
  }
  OcclusionCuller* occlusion_culler() override { return plugin_.query != nullptr ? this : nullptr; }
  PictureDrawer* picture_drawer() override {
    return plugin_.draw_picture != nullptr ? this : nullptr;
  }
  cases::Contract promise(const cases::Case& c) const override {
    return contract_of(plugin_.contract, c);
  }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override;
  Result<bool> is_occluded(const cases::Case& c, std::size_t occluders) override {
    return query_.ask(plugin_, c, occluders);
  }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    return picture_.draw(plugin_, c, pipeline);
  }
  Result<void> hand_over(const cases::Case& c);
  Result<void> append(std::uint32_t first, std::uint32_t count, cases::Fragments& drawn);
  Result<void> call();
  Result<void> check_fronts() const;
  Result<void> check_output(std::uint32_t triangles) const;
  void clear();
  void collect(std::uint32_t first, cases::Fragments& drawn) const;
  static Rectangle covered_since(std::size_t begin, const cases::Fragments& drawn);
  Rectangle whole() const { return {0, 0, draw_.width, draw_.height}; }
  Rectangle touched() const { return {output_.min_x, output_.min_y, output_.max_x, output_.max_y}; }
  bool is_searched_whole() const { return sample_count() <= kSearchedWhole; }

  std::size_t sample_count() const {
    return std::size_t{draw_.width} * draw_.height * draw_.samples;
  }
  std::size_t index_of(const cases::SamplePlace& at) const {
    return (std::size_t{at.y} * draw_.width + at.x) * draw_.samples + at.sample;
  }
  /// Visits the covered samples as if they were of triangle 0. Skips uncovered samples in groups of
  /// eight.
  template <typename Visit>
  void each_covered(const Rectangle& part, const Visit& visit) const {
    const auto* const coverage = arrays_.coverage.as<const std::uint8_t>();
    for (std::uint32_t y = part.min_y; y < part.max_y; ++y) {
      const std::uint8_t* const row = coverage + index_of({0, y, 0, 0});
      const std::uint8_t* const end = row + std::size_t{part.max_x} * draw_.samples;
      const auto is_covered = [](std::uint8_t byte) { return byte != 0; };
      for (const std::uint8_t* at = row + std::size_t{part.min_x} * draw_.samples;; ++at) {
        std::uint64_t eight = 0;
        while (end - at >= 8 && (std::memcpy(&eight, at, 8), eight == 0)) at += 8;
        at = std::find_if(at, end, is_covered);
        if (at == end) break;
        const auto index = static_cast<std::uint32_t>(at - row);
        visit(cases::SamplePlace{0, y, index / draw_.samples, index % draw_.samples});
      }
    }
  }
  /// The error for a process that cannot allocate any more memory.
  tl::unexpected<Error> no_memory() const {
    return fail(fmt::format("arrays for {} x {} pixels of {} samples do not fit into the memory of "
                            "its process",
                            draw_.width, draw_.height, draw_.samples),
                Failure::unsupported);
  }
  tl::unexpected<Error> fail(const std::string& reason, Failure failure = Failure::refused) const {
    return tl::unexpected(Error{"plugin:" + path_, "", reason, failure});
  }

  std::string path_;
  Plugin plugin_;
  OcclusionQuery query_;
  PictureDrawing picture_;
  Arrays arrays_;
  rastercheck_draw draw_{};
  rastercheck_output output_{};
  Rectangle dirty_;    ///< where the last draw may have left coverage in the output
  Rectangle written_;  ///< where the other arrays are cleared; holds all samples covered last time
};

Result<cases::Fragments> PluginBackend::draw_fragments(const cases::Case& c) {
  if (const std::string what = lacks(plugin_.contract, c); !what.empty()) {
    return fail("its contract lacks " + what, Failure::unsupported);
  }
  if (Result<void> handed = hand_over(c); !handed) return tl::unexpected(std::move(handed).error());
  cases::Fragments drawn;
  drawn.attribute_count = c.attributes.size();
  const auto triangles = static_cast<std::uint32_t>(c.triangles.size());
  const std::uint32_t together = draw_.depth_test != 0 ? triangles : 1;
  for (std::uint32_t first = 0; first < triangles; first += together) {
    Result<void> appended = append(first, together, drawn);
    if (!appended) return tl::unexpected(std::move(appended).error());
  }
  return drawn;
}

/// Hands over everything that is the same for all draws of a case.
Result<void> PluginBackend::hand_over(const cases::Case& c) {
  draw_ = draw_state(c, promise(c));
  const std::vector<float> places = sample_places(c);
  const std::vector<rastercheck_attribute> attributes = plugin_attributes(c);
  const std::array<std::pair<GuardedArray*, std::span<const std::byte>>, 6> inputs{
      {{&arrays_.sample_positions, bytes_of(places)},
       {&arrays_.positions, bytes_of(c.positions)},
       {&arrays_.attributes, bytes_of(attributes)},
       {&arrays_.attribute_values, bytes_of(c.attribute_values)},
       {&arrays_.clip_distances, bytes_of(c.clip_distances)},
       {&arrays_.indices, bytes_of(c.triangles)}}};
  for (const auto& [array, bytes] : inputs) {
    if (!array->assign(bytes)) return no_memory();
  }
  draw_.sample_positions = arrays_.sample_positions.as<const float>();
  draw_.positions = arrays_.positions.as<const float>();
  draw_.attributes = arrays_.attributes.as<const rastercheck_attribute>();
  draw_.attribute_values = arrays_.attribute_values.as<const float>();
  draw_.clip_distances = arrays_.clip_distances.as<const float>();

  const std::size_t samples = sample_count();
  const std::array<std::pair<GuardedArray*, std::size_t>, 5> outputs{
      {{&arrays_.coverage, samples},
       {&arrays_.triangle, samples * sizeof(std::uint32_t)},
       {&arrays_.depth, samples * sizeof(float)},
       {&arrays_.values, samples * c.attributes.size() * sizeof(float)},
       {&arrays_.message, kMessageSize}}};
  for (const auto& [array, size] : outputs) {
    if (!array->resize(size)) return no_memory();
  }
  dirty_ = whole();
  written_ = whole();
  return {};
}

Result<void> PluginBackend::append(std::uint32_t first, std::uint32_t count,
                                   cases::Fragments& drawn) {
  clear();
  draw_.triangle_count = count;
  draw_.indices = arrays_.indices.as<const std::uint32_t>() + std::size_t{first} * 3;
  if (Result<void> called = call(); !called) return called;
  if (Result<void> checked = check_output(count); !checked) return checked;
  const std::size_t begin = drawn.size();
  collect(first, drawn);
  dirty_ = is_searched_whole() ? whole() : touched();
  const std::size_t wide = std::size_t{dirty_.max_x - dirty_.min_x} * draw_.samples;
  const bool is_small = wide * (dirty_.max_y - dirty_.min_y) <= kSearchedWhole;
  written_ = is_small ? dirty_ : covered_since(begin, drawn);
  return {};
}

/// The bounding box, in pixels, of the fragments from index `begin` on.
Rectangle PluginBackend::covered_since(std::size_t begin, const cases::Fragments& drawn) {
  Rectangle part;
  if (begin == drawn.size()) return part;
  const auto from = static_cast<std::ptrdiff_t>(begin);
  const auto [least_x, most_x] = std::minmax_element(drawn.x.begin() + from, drawn.x.end());
  const auto [least_y, most_y] = std::minmax_element(drawn.y.begin() + from, drawn.y.end());
  part.min_x = *least_x;
  part.min_y = *least_y;
  part.max_x = *most_x + 1U;
  part.max_y = *most_y + 1U;
  return part;
}

/// Clears the output for the next draw: all coverage that the last draw may have left, and the
/// other arrays where the plugin may have written. If the rectangle that the plugin reported is
/// large, clears the other arrays only in the bounding box of the samples that the last draw
/// covered.
void PluginBackend::clear() {
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  for (std::uint32_t y = dirty_.min_y; y < dirty_.max_y; ++y) {
    std::fill_n(arrays_.coverage.as<std::uint8_t>() + index_of({0, y, dirty_.min_x, 0}),
                std::size_t{dirty_.max_x - dirty_.min_x} * draw_.samples, std::uint8_t{0});
  }
  const Rectangle& part = written_;
  const std::size_t row = std::size_t{part.max_x - part.min_x} * draw_.samples;
  for (std::uint32_t y = part.min_y; y < part.max_y; ++y) {
    const std::size_t begin = index_of({0, y, part.min_x, 0});
    std::fill_n(arrays_.triangle.as<std::uint32_t>() + begin, row, 0U);
    std::fill_n(arrays_.depth.as<float>() + begin, row, kNothing);
    const std::size_t count = draw_.attribute_count;
    if (count > 0) std::fill_n(arrays_.values.as<float>() + begin * count, row * count, kNothing);
  }
  std::fill_n(arrays_.message.as<char>(), kMessageSize, '\0');
  output_ = {};
  output_.size = sizeof output_;
  output_.coverage = arrays_.coverage.as<std::uint8_t>();
  output_.triangle = arrays_.triangle.as<std::uint32_t>();
  output_.depth = arrays_.depth.as<float>();
  output_.attributes = arrays_.values.as<float>();
  output_.max_x = draw_.width;
  output_.max_y = draw_.height;
  output_.message = arrays_.message.as<char>();
  output_.message_size = kMessageSize;
}

Result<void> PluginBackend::call() {
  // Hands over copies, so that the plugin cannot change the originals. From the copies, only the
  // rectangle that the plugin reports is copied back.
  const rastercheck_draw draw = draw_;
  rastercheck_output output = output_;
  const Result<void> called = ForeignCall{path_, "draw", &arrays_.message}(
      [&] { return plugin_.draw(&draw, &output); }, [this] { return check_fronts(); });
  output_.min_x = output.min_x;
  output_.min_y = output.min_y;
  output_.max_x = output.max_x;
  output_.max_y = output.max_y;
  return called;
}

Result<void> PluginBackend::check_fronts() const {
  for (const auto& [array, name] :
       {std::pair(&arrays_.coverage, "coverage"), std::pair(&arrays_.triangle, "triangle"),
        std::pair(&arrays_.depth, "depth"), std::pair(&arrays_.values, "attributes"),
        std::pair(&arrays_.message, "message")}) {
    if (array->size() == 0 || array->is_front_whole()) continue;
    return fail(fmt::format("draw() wrote before the beginning of output->{}", name));
  }
  return {};
}

/// Checks that the output obeys the rules of plugin.h.
Result<void> PluginBackend::check_output(std::uint32_t triangles) const {
  const Rectangle part = touched();
  if (part.min_x > part.max_x || part.min_y > part.max_y || part.max_x > draw_.width ||
      part.max_y > draw_.height) {
    return fail(
        fmt::format("draw() reported an invalid covered part: x from {} to {}, y from {} to {}, of "
                    "{} x {} pixels",
                    part.min_x, part.max_x, part.min_y, part.max_y, draw_.width, draw_.height));
  }
  std::string fault;
  each_covered(is_searched_whole() ? whole() : part, [&](const cases::SamplePlace& at) {
    const unsigned coverage = arrays_.coverage.as<const std::uint8_t>()[index_of(at)];
    if (!fault.empty()) return;
    const std::uint32_t triangle = arrays_.triangle.as<const std::uint32_t>()[index_of(at)];
    const bool is_inside =
        part.min_x <= at.x && at.x < part.max_x && part.min_y <= at.y && at.y < part.max_y;
    if (coverage != 1) {
      fault = fmt::format("wrote {} to output->coverage, which must be 0 or 1", coverage);
    } else if (!is_inside) {
      fault = "covered a sample outside the min_x, min_y, max_x, max_y that it reported";
    } else if (triangle >= triangles) {
      fault =
          fmt::format("wrote {} to output->triangle, which must be below {}", triangle, triangles);
    }
    if (!fault.empty()) {
      fault = fmt::format("draw() {} (pixel {}, {}, sample {})", fault, at.x, at.y, at.sample);
    }
  });
  if (!fault.empty()) return fail(fault);
  return {};
}

/// Appends the covered samples in the order that Fragments requires.
void PluginBackend::collect(std::uint32_t first, cases::Fragments& drawn) const {
  std::vector<cases::SamplePlace> places;
  each_covered(touched(), [&](cases::SamplePlace at) {
    at.triangle = arrays_.triangle.as<const std::uint32_t>()[index_of(at)];
    places.push_back(at);
  });
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
  for (const cases::SamplePlace& at : places) {
    const std::size_t index = index_of(at);
    drawn.triangle.push_back(first + at.triangle);
    drawn.x.push_back(static_cast<std::uint16_t>(at.x));
    drawn.y.push_back(static_cast<std::uint16_t>(at.y));
    drawn.sample.push_back(static_cast<std::uint8_t>(at.sample));
    drawn.depth.push_back(arrays_.depth.as<const float>()[index]);
    for (std::size_t i = 0; i < draw_.attribute_count; ++i) {
      drawn.attributes.push_back(
          arrays_.values.as<const float>()[index * draw_.attribute_count + i]);
    }
  }
}

Result<std::unique_ptr<Backend>> make(const std::string& path) {
  report_wrong_accesses();
  Result<Plugin> plugin = load_plugin(path);
  if (!plugin) return tl::unexpected(plugin.error());
  return std::make_unique<PluginBackend>(path, *std::move(plugin));
}

std::vector<Listing> list() {
  return {{"plugin:PATH.so", "your shared library (rastercheck plugin new)",
           "PATH must name the library"}};
}

const BackendRegistration kRegistration({"plugin", &make, &list, true});

}  // namespace
}  // namespace rastercheck::backends::plugin_registration

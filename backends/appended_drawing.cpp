#include "backends/appended_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "backends/primitive_vertices.h"

namespace rastercheck::backends {
namespace {

/// Maximum number of triangles per draw. Progress is reported after each draw.
constexpr std::size_t kMostOfDraw = 16384;
/// Limits on how many triangles of a draw are also drawn into layers, and on the total number of
/// pixels of those layers, which are read back whole.
constexpr std::size_t kCheckedOfDraw = 8;
constexpr std::size_t kCheckedPixels = std::size_t{1} << 21U;
/// Number of records that the first draw has room for.
constexpr std::size_t kFirstRoom = std::size_t{1} << 14U;

tl::unexpected<Error> wrong_record(std::string reason) {
  return tl::unexpected(Error{"", "", std::move(reason)});
}

/// A case without its triangles and their vertices.
cases::Case without_triangles(const cases::Case& c) {
  cases::Case state = c;
  state.positions.clear();
  state.attribute_values.clear();
  state.clip_distances.clear();
  state.triangles.clear();
  return state;
}

/// Returns a case with the given primitives of `c`, each with its own vertices. `state` is the rest
/// of the case.
cases::Case part_of(const cases::Case& c, cases::Case state,
                    std::span<const std::size_t> triangles) {
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const std::size_t t : triangles) {
    const auto first = static_cast<std::uint32_t>(state.positions.size());
    const auto vertices = vertices_of(c.primitive, c.triangles[t]);
    const auto last = first + static_cast<std::uint32_t>(vertices.size()) - 1;
    state.triangles.push_back({first, std::min(first + 1, last), last});
    for (const std::uint32_t vertex : vertices) {
      state.positions.push_back(c.positions[vertex]);
      append(state.attribute_values, c.attributes_of(vertex));
      append(state.clip_distances, c.clip_distances_of(vertex));
    }
  }
  return state;
}

bool are_same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

/// The records of one draw.
class Records {
 public:
  Records(std::span<const std::uint32_t> words, const RecordLayout& layout)
      : words_(words), layout_(&layout) {}

  std::size_t size() const { return words_.size() / layout_->words; }
  float number(std::size_t i) const { return std::bit_cast<float>(word(i, 0)); }
  std::uint32_t pixel(std::size_t i) const { return word(i, 1); }
  float depth(std::size_t i) const { return std::bit_cast<float>(word(i, 2)); }
  const RecordLayout& layout() const { return *layout_; }
  float value(std::size_t i, std::size_t at) const { return std::bit_cast<float>(word(i, at)); }

  /// Indices of the records, ordered by triangle, y and x. Fails unless each record's triangle
  /// number is an integer from 1 to `triangles`.
  Result<std::vector<std::size_t>> order(std::size_t triangles) const {
    std::vector<std::size_t> begins(triangles + 1);
    for (std::size_t i = 0; i < size(); ++i) {
      const float given = number(i);
      const bool is_one =
          given >= 1 && given <= static_cast<float>(triangles) && given == std::floor(given);
      if (!is_one)
        return wrong_record(fmt::format("a flat triangle number was drawn as {}", given));
      ++begins[static_cast<std::size_t>(given)];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::size_t> sorted(size());
    std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
    for (std::size_t i = 0; i < size(); ++i) {
      sorted[next[static_cast<std::size_t>(number(i)) - 1]++] = i;
    }
    for (std::size_t t = 0; t < triangles; ++t) {
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begins[t]),
                sorted.begin() + static_cast<std::ptrdiff_t>(begins[t + 1]),
                [this](std::size_t a, std::size_t b) { return goes_before(a, b); });
    }
    return sorted;
  }

 private:
  /// Orders records by pixel, and records of the same pixel by their bits.
  bool goes_before(std::size_t a, std::size_t b) const {
    const auto record = [this](std::size_t i) {
      return words_.subspan(i * layout_->words + 1, layout_->words - 1);
    };
    return std::ranges::lexicographical_compare(record(a), record(b));
  }
  std::uint32_t word(std::size_t i, std::size_t at) const {
    return words_[i * layout_->words + at];
  }

  std::span<const std::uint32_t> words_;
  const RecordLayout* layout_;
};

class AppendedDrawing {
 public:
  AppendedDrawing(const cases::Case& c, std::span<const RecordLayout> layouts,
                  const AppendingDriver& driver, bool is_checked,
                  const std::function<void()>& go_on)
      : case_(&c),
        state_(without_triangles(c)),
        layouts_(layouts),
        driver_(&driver),
        is_checked_(is_checked),
        go_on_(&go_on) {
    drawn_.attribute_count = c.attributes.size();
    const auto [least, greatest] = std::minmax(c.viewport.min_depth, c.viewport.max_depth);
    least_depth_ = least;
    greatest_depth_ = greatest;
  }

  Result<cases::Fragments> draw() {
    // Limits each draw so that its fragments fit into the shader's 32-bit counter.
    const auto pixels = static_cast<std::size_t>(case_->framebuffer.width) *
                        static_cast<std::size_t>(case_->framebuffer.height);
    const std::size_t most = std::clamp<std::size_t>(0xFFFFFFFFU / pixels, 1, kMostOfDraw);
    std::size_t count = most;
    for (std::size_t first = 0; first < case_->triangles.size();) {
      count = std::min(count, case_->triangles.size() - first);
      const Result<std::size_t> done = draw_some(first, count);
      if (!done) return tl::unexpected(done.error());
      first += *done;
      // If the room limited this draw, it will probably limit the next one as well.
      count = std::min(most, 2 * *done);
      (*go_on_)();
    }
    return std::move(drawn_);
  }

 private:
  /// Draws `count` triangles, or fewer if the room for records does not suffice; returns how many.
  Result<std::size_t> draw_some(std::size_t first, std::size_t count);
  Result<void> add(const Records& records, std::size_t first, std::size_t count);
  Result<void> add_values(const Records& records, std::size_t begin, std::size_t first,
                          std::size_t count);
  Result<void> add_layers(std::size_t first, std::size_t count);
  void drop(std::size_t begin);
  Result<void> store_depths(std::size_t begin);
  Result<bool> check_some(std::size_t begin, std::size_t first, std::size_t count) const;
  bool is_same_fragment(std::size_t i, const cases::Fragments& layers, std::size_t at) const;

  bool is_in_range(float depth) const {
    return depth >= least_depth_ && depth <= greatest_depth_ && !std::signbit(depth);
  }
  /// True if the fragment and the record have the same triangle and pixel.
  bool is_at(std::size_t fragment, const Records& records, std::size_t i, std::size_t first) const {
    return drawn_.triangle[fragment] + 1 - first == static_cast<std::size_t>(records.number(i)) &&
           drawn_.x[fragment] + (std::uint32_t{drawn_.y[fragment]} << 16U) == records.pixel(i);
  }
  void set_values(std::size_t fragment, const Records& records, std::size_t i) {
    for (const auto& [word, attribute] : records.layout().values) {
      drawn_.attributes[fragment * drawn_.attribute_count + attribute] = records.value(i, word);
    }
  }

  const cases::Case* case_;
  cases::Case state_;  ///< the case without its triangles
  std::span<const RecordLayout> layouts_;
  const AppendingDriver* driver_;
  bool is_checked_;
  const std::function<void()>* go_on_;
  float least_depth_ = 0;
  float greatest_depth_ = 1;
  std::size_t room_ = kFirstRoom;
  cases::Fragments drawn_;
};

Result<std::size_t> AppendedDrawing::draw_some(std::size_t first, std::size_t count) {
  const std::size_t begin = drawn_.size();
  for (std::size_t pass = 0; pass < layouts_.size(); ++pass) {
    const std::size_t most = driver_->most_words / layouts_[pass].words;
    room_ = std::min(room_, most);
    Result<std::size_t> had = driver_->draw(pass, first, count, room_);
    if (!had) return had;
    if (*had > room_ && *had <= most) {
      room_ = std::min(most, std::bit_ceil(*had));
      had = driver_->draw(pass, first, count, room_);
      if (!had) return had;
    }
    if (*had > room_) {
      if (pass > 0)
        return wrong_record("the same triangles had more fragments when they were drawn again");
      if (count > 1) {
        return draw_some(first, std::clamp<std::size_t>(count * most / *had, 1, count - 1));
      }
      const Result<void> added = add_layers(first, 1);
      if (!added) return tl::unexpected(added.error());
      return count;
    }
    const Records records(driver_->records().first(*had * layouts_[pass].words), layouts_[pass]);
    const Result<void> added =
        pass == 0 ? add(records, first, count) : add_values(records, begin, first, count);
    if (!added) return tl::unexpected(added.error());
  }
  const Result<void> stored = store_depths(begin);
  if (!stored) return tl::unexpected(stored.error());
  if (!is_checked_) return count;
  const Result<bool> is_same = check_some(begin, first, count);
  if (!is_same) return tl::unexpected(is_same.error());
  if (*is_same) return count;
  drop(begin);
  const Result<void> drawn = add_layers(first, count);
  if (!drawn) return tl::unexpected(drawn.error());
  return count;
}

Result<void> AppendedDrawing::add(const Records& records, std::size_t first, std::size_t count) {
  const Result<std::vector<std::size_t>> order = records.order(count);
  if (!order) return tl::unexpected(order.error());
  drawn_.attributes.resize((drawn_.size() + order->size()) * drawn_.attribute_count);
  for (const std::size_t i : *order) {
    const auto x = static_cast<std::uint16_t>(records.pixel(i) & 0xFFFFU);
    const auto y = static_cast<std::uint16_t>(records.pixel(i) >> 16U);
    const std::size_t triangle = first + static_cast<std::size_t>(records.number(i)) - 1;
    drawn_.triangle.push_back(static_cast<std::uint32_t>(triangle));
    drawn_.x.push_back(x);
    drawn_.y.push_back(y);
    drawn_.sample.push_back(0);
    drawn_.depth.push_back(records.depth(i));
    set_values(drawn_.size() - 1, records, i);
  }
  return {};
}

Result<void> AppendedDrawing::add_values(const Records& records, std::size_t begin,
                                         std::size_t first, std::size_t count) {
  const Result<std::vector<std::size_t>> order = records.order(count);
  if (!order) return tl::unexpected(order.error());
  bool is_same = order->size() == drawn_.size() - begin;
  for (std::size_t k = 0; k < order->size() && is_same; ++k) {
    is_same = is_at(begin + k, records, (*order)[k], first);
    if (is_same) set_values(begin + k, records, (*order)[k]);
  }
  if (is_same) return {};
  return wrong_record(
      "the case covered other samples when it was drawn again with its other attributes");
}

/// Removes all fragments from index `begin` on.
void AppendedDrawing::drop(std::size_t begin) {
  drawn_.triangle.resize(begin);
  drawn_.x.resize(begin);
  drawn_.y.resize(begin);
  drawn_.sample.resize(begin);
  drawn_.depth.resize(begin);
  drawn_.attributes.resize(begin * drawn_.attribute_count);
}

Result<void> AppendedDrawing::add_layers(std::size_t first, std::size_t count) {
  std::vector<std::size_t> triangles(count);
  std::iota(triangles.begin(), triangles.end(), first);
  Result<cases::Fragments> layers = driver_->draw_in_layers(part_of(*case_, state_, triangles));
  if (!layers) return tl::unexpected(layers.error());
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const std::uint32_t t : layers->triangle) {
    drawn_.triangle.push_back(static_cast<std::uint32_t>(first + t));
  }
  append(drawn_.x, layers->x);
  append(drawn_.y, layers->y);
  append(drawn_.sample, layers->sample);
  append(drawn_.depth, layers->depth);
  append(drawn_.attributes, layers->attributes);
  return {};
}

/// Replaces depths that are NaN or beyond the depth range by depths drawn into layers, since only
/// the driver knows what a depth buffer holds then. Considers fragments from index `begin` on.
Result<void> AppendedDrawing::store_depths(std::size_t begin) {
  std::vector<std::size_t> triangles;
  for (std::size_t i = begin; i < drawn_.size(); ++i) {
    const std::size_t triangle = drawn_.triangle[i];
    const bool is_new = triangles.empty() || triangles.back() != triangle;
    if (!is_in_range(drawn_.depth[i]) && is_new) triangles.push_back(triangle);
  }
  if (triangles.empty()) return {};
  const Result<cases::Fragments> layers =
      driver_->draw_in_layers(part_of(*case_, state_, triangles));
  if (!layers) return tl::unexpected(layers.error());
  std::size_t i = begin;
  for (std::size_t at = 0; at < layers->size(); ++at) {
    cases::SamplePlace place = layers->place_of(at);
    place.triangle = static_cast<std::uint32_t>(triangles[place.triangle]);
    while (i < drawn_.size() && drawn_.place_of(i) < place) ++i;
    const bool is_there = i < drawn_.size() && drawn_.place_of(i) == place;
    if (is_there && !is_in_range(drawn_.depth[i])) drawn_.depth[i] = layers->depth[at];
  }
  return {};
}

/// Draws a few triangles, evenly spaced among the `count` from `first` on, into layers. Returns
/// true if the layers hold the same fragments of these triangles as the list from index `begin` on.
Result<bool> AppendedDrawing::check_some(std::size_t begin, std::size_t first,
                                         std::size_t count) const {
  std::vector<std::size_t> chosen;
  const cases::FramebufferSize& size = case_->framebuffer;
  const std::size_t pixels =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  const std::size_t wanted = std::clamp<std::size_t>(kCheckedPixels / pixels, 1, kCheckedOfDraw);
  const std::size_t step = std::max<std::size_t>(count / wanted, 1);
  for (std::size_t t = step / 2; t < count; t += step) chosen.push_back(first + t);
  const Result<cases::Fragments> layers = driver_->draw_in_layers(part_of(*case_, state_, chosen));
  if (!layers) return tl::unexpected(layers.error());
  std::size_t at = 0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto from = drawn_.triangle.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto [low, high] =
        std::equal_range(from, drawn_.triangle.end(), static_cast<std::uint32_t>(chosen[k]));
    auto i = static_cast<std::size_t>(low - drawn_.triangle.begin());
    const auto end = static_cast<std::size_t>(high - drawn_.triangle.begin());
    for (; at < layers->size() && layers->triangle[at] == k; ++at, ++i) {
      if (i == end || !is_same_fragment(i, *layers, at)) return false;
    }
    if (i != end) return false;
  }
  return true;
}

bool AppendedDrawing::is_same_fragment(std::size_t i, const cases::Fragments& layers,
                                       std::size_t at) const {
  const auto values = drawn_.attributes_of(i);
  return drawn_.x[i] == layers.x[at] && drawn_.y[i] == layers.y[at] &&
         are_same_bits(drawn_.depth[i], layers.depth[at]) &&
         std::equal(values.begin(), values.end(), layers.attributes_of(at).begin(), are_same_bits);
}

}  // namespace

std::string lacks_of_appending(const cases::Case& c) {
  if (c.framebuffer.samples > 1) return "appending supports only one sample per pixel";
  if (c.depth_test != cases::DepthTest::none) return "appending does not support a depth test";
  if (c.depth_clamp)
    return "appending does not support depth clamp, which changes depths only when they are stored";
  if (!c.depth_bias.is_none() || cases::unorm_bits(c.depth_format) != 0)
    return "appending supports neither a depth bias nor unorm depth, which only a depth buffer has";
  return "";
}

void RecordLayout::add_vector(std::span<const std::size_t> attributes) {
  for (std::size_t k = 0; k < attributes.size(); ++k) values.push_back({words + k, attributes[k]});
  words += 4;
}

Result<cases::Fragments> draw_appended(const cases::Case& c, std::span<const RecordLayout> layouts,
                                       const AppendingDriver& driver, bool is_checked,
                                       const std::function<void()>& go_on) {
  return AppendedDrawing(c, layouts, driver, is_checked, go_on).draw();
}

}  // namespace rastercheck::backends

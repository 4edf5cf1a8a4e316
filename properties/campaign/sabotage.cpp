#include "properties/campaign/sabotage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "oracle/judge.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::Fragments;

/// Whether two drawings are the same to the bit.
bool are_same(const Fragments& a, const Fragments& b) {
  const auto are = [](const std::vector<float>& x, const std::vector<float>& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0);
  };
  return a.triangle == b.triangle && a.x == b.x && a.y == b.y && a.sample == b.sample &&
         are(a.depth, b.depth) && are(a.attributes, b.attributes);
}

std::optional<Fragments> unless_same(const Drawing& drawing, Fragments other) {
  if (are_same(*drawing.fragments, other)) return std::nullopt;
  return other;
}

/// All attribute values but flat ones changed by a function of (fragment, attribute).
template <typename Change>
std::optional<Fragments> with_values(const Drawing& drawing, const Change& change) {
  Fragments other = *drawing.fragments;
  const std::size_t count = other.attribute_count;
  for (std::size_t i = 0; i < other.size(); ++i) {
    for (std::size_t a = 0; a < count; ++a) {
      if (drawing.source->attributes[a].interpolation == cases::Interpolation::flat) continue;
      float& value = other.attributes[i * count + a];
      value = change(i, a, value);
    }
  }
  return unless_same(drawing, std::move(other));
}

template <int kThousandths>
std::optional<Fragments> scale_values(const Drawing& drawing) {
  return with_values(drawing, [](std::size_t, std::size_t, float value) {
    return static_cast<float>(double{value} * kThousandths / 1000);
  });
}

std::optional<Fragments> no_numbers(const Drawing& drawing) {
  return with_values(drawing, [](std::size_t, std::size_t, float) {
    return std::numeric_limits<float>::quiet_NaN();
  });
}

std::optional<Fragments> one_number(const Drawing& drawing) {
  return with_values(drawing, [](std::size_t, std::size_t, float) { return 12345.0F; });
}

template <int kThousandths>
std::optional<Fragments> scale_depths(const Drawing& drawing) {
  Fragments other = *drawing.fragments;
  for (float& depth : other.depth) depth = static_cast<float>(double{depth} * kThousandths / 1000);
  return unless_same(drawing, std::move(other));
}

/// A triangle in its window, near enough for defects of a thousandth; nothing behind the eye.
class NearTriangle {
 public:
  NearTriangle(const Case& c, std::size_t triangle) : case_(&c), indices_(c.triangles[triangle]) {
    for (std::size_t i = 0; i < 3; ++i) {
      const cases::ClipVertex& p = c.positions[indices_[i]];
      if (!(p.w > 0)) is_whole_ = false;
      const double sign = c.rules == cases::Rules::d3d ? -1 : 1;
      w_[i] = double{p.w};
      x_[i] = (p.x / w_[i] + 1) * double{c.viewport.width} / 2 + double{c.viewport.x};
      y_[i] = (sign * p.y / w_[i] + 1) * double{c.viewport.height} / 2 + double{c.viewport.y};
    }
    area_ = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (x_[2] - x_[0]) * (y_[1] - y_[0]);
  }

  bool is_whole() const { return is_whole_ && area_ != 0; }

  double at(std::size_t attribute, bool is_perspective, double x, double y) const {
    double sum = 0;
    double weights = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      const double e = (x_[j] - x) * (y_[k] - y) - (x_[k] - x) * (y_[j] - y);
      const double weight = is_perspective ? e / w_[i] : e;
      sum += weight * double{case_->attributes_of(indices_[i])[attribute]};
      weights += weight;
    }
    return sum / weights;
  }

 private:
  const Case* case_;
  cases::Triangle indices_;
  std::array<double, 3> x_{};
  std::array<double, 3> y_{};
  std::array<double, 3> w_{};
  double area_ = 0;
  bool is_whole_ = true;
};

/// Values to which a defect adds what `difference(triangle, attribute, x, y)` says.
template <typename Difference>
std::optional<Fragments> add_to_values(const Drawing& drawing, const Difference& difference) {
  const Case& c = *drawing.source;
  std::vector<NearTriangle> triangles;
  triangles.reserve(c.triangles.size());
  for (std::size_t t = 0; t < c.triangles.size(); ++t) triangles.emplace_back(c, t);
  const Fragments& drawn = *drawing.fragments;
  return with_values(drawing, [&](std::size_t i, std::size_t a, float value) {
    const NearTriangle& triangle = triangles[drawn.triangle[i]];
    if (!triangle.is_whole()) return value;
    return static_cast<float>(double{value} +
                              difference(triangle, a, drawn.x[i] + 0.5, drawn.y[i] + 0.5));
  });
}

bool is_smooth(const Case& c, std::size_t attribute) {
  return c.attributes[attribute].interpolation == cases::Interpolation::smooth;
}

std::optional<Fragments> half_a_pixel_off(const Drawing& drawing) {
  const Case& c = *drawing.source;
  return add_to_values(drawing, [&c](const NearTriangle& t, std::size_t a, double x, double y) {
    return t.at(a, is_smooth(c, a), x + 0.5, y + 0.5) - t.at(a, is_smooth(c, a), x, y);
  });
}

std::optional<Fragments> affine_for_perspective(const Drawing& drawing) {
  const Case& c = *drawing.source;
  return add_to_values(drawing, [&c](const NearTriangle& t, std::size_t a, double x, double y) {
    return is_smooth(c, a) ? t.at(a, false, x, y) - t.at(a, true, x, y) : 0.0;
  });
}

/// Everything moved right by a part of a pixel.
template <int kParts>
std::optional<Fragments> moved(const Drawing& drawing) {
  Case other = *drawing.source;
  // The viewport stays: what moves are the vertices.
  for (cases::ClipVertex& p : other.positions) {
    p.x =
        static_cast<float>(double{p.x} + double{p.w} * 2 / (kParts * double{other.viewport.width}));
  }
  std::optional<Fragments> drawn = drawing.draw(other);
  if (!drawn) return std::nullopt;
  return unless_same(drawing, *std::move(drawn));
}

constexpr std::array<Sabotage, 15> kSabotages{{
    {"values × 0.97", &scale_values<970>},
    {"values × 0.99", &scale_values<990>},
    {"values × 0.999", &scale_values<999>},
    {"values half a pixel off", &half_a_pixel_off},
    {"affine for perspective", &affine_for_perspective},
    {"values NaN", &no_numbers},
    {"values 12345", &one_number},
    {"depth × 0.9", &scale_depths<900>},
    {"depth × 0.99", &scale_depths<990>},
    {"depth × 0.999", &scale_depths<999>},
    {"all moved 1/2 px", &moved<2>},
    {"all moved 1/16 px", &moved<16>},
    {"all moved 1/64 px", &moved<64>},
    {"all moved 1/256 px", &moved<256>},
    {"all moved 1/1024 px", &moved<1024>},
}};

}  // namespace

std::span<const Sabotage> sabotages() { return kSabotages; }

bool is_noticed(const cases::ClipCase& source, const cases::Contract& contract,
                const Fragments& drawn) {
  const oracle::SceneTruth scene(source, contract);
  oracle::JudgeOptions options;
  options.self_check_one_in = 0;
  const records::Judgement judged = oracle::judge(scene, drawn, options).judgement;
  return std::any_of(judged.errors.begin(), judged.errors.end(), [](const auto& of_kind) {
    const records::ClassCounts& classes = of_kind.second.classes;
    for (std::size_t i = 0; i < classes.counts.size(); ++i) {
      const auto fragment_class = static_cast<records::FragmentClass>(i);
      if (fragment_class != records::FragmentClass::correct && classes.counts[i] > 0) return true;
    }
    return false;
  });
}

}  // namespace rastercheck::properties

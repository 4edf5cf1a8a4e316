#include "cli/gallery/internal/panel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "oracle/judge.h"
#include "records/error_map.h"
#include "records/histogram.h"
#include "reports/error_picture.h"

namespace rastercheck::gallery {
namespace {

using records::PixelState;
using reports::Color;
using reports::Image;

/// The visible fragments: for each sample the nearest one that the shader draws.
class Seen {
 public:
  struct Sample {
    std::optional<Color> color;
    std::uint32_t triangle = 0;
    float depth = std::numeric_limits<float>::infinity();
  };

  Seen(const DrawnScene& drawn, const Shader& shader)
      : size_(drawn.scene.framebuffer),
        samples_(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height) *
                 static_cast<std::size_t>(size_.samples)) {
    const cases::Fragments& fragments = drawn.fragments;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      if (!has(fragments.x[i], fragments.y[i], fragments.sample[i])) continue;
      Sample& sample = samples_[index(fragments.x[i], fragments.y[i], fragments.sample[i])];
      if (!(fragments.depth[i] < sample.depth)) continue;
      const std::optional<Color> color = shader(fragments.triangle[i], fragments.attributes_of(i));
      if (color) sample = {color, fragments.triangle[i], fragments.depth[i]};
    }
  }

  bool has(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    return std::cmp_less(x, size_.width) && std::cmp_less(y, size_.height) &&
           std::cmp_less(sample, size_.samples);
  }

  bool shows(const oracle::JudgedSample& judged) const {
    if (!has(judged.place.x, judged.place.y, judged.place.sample)) return false;
    const Sample& sample = samples_[index(judged.place.x, judged.place.y, judged.place.sample)];
    return sample.color && sample.triangle == judged.place.triangle;
  }

  Image picture() const {
    Image image = Image::filled(size_.width, size_.height, reports::kUndrawn);
    for (int y = 0; y < size_.height; ++y) {
      for (int x = 0; x < size_.width; ++x) image.set(x, y, mean(x, y));
    }
    return image;
  }

 private:
  std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    return (std::size_t{y} * static_cast<std::size_t>(size_.width) + x) *
               static_cast<std::size_t>(size_.samples) +
           sample;
  }

  /// Returns the mean colour of a pixel's samples in linear light. Takes the square of a level as
  /// linear light: this is close enough to sRGB, and the same on every machine.
  Color mean(int x, int y) const {
    std::array<double, 3> sums{};
    for (int k = 0; k < size_.samples; ++k) {
      const Sample& sample =
          samples_[index(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                         static_cast<std::uint32_t>(k))];
      const Color color = sample.color.value_or(reports::kUndrawn);
      for (std::size_t c = 0; c < 3; ++c) {
        const double level = color[c];
        sums[c] += level * level;
      }
    }
    Color color{};
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] = static_cast<std::uint8_t>(std::lround(std::sqrt(sums[c] / size_.samples)));
    }
    return color;
  }

  cases::FramebufferSize size_;
  std::vector<Sample> samples_;
};

/// Returns the ulp of the attribute's largest magnitude at the triangle's vertices.
double ulp_of(const cases::Case& scene, std::uint32_t triangle, std::uint32_t attribute) {
  double magnitude = 0;
  for (const std::uint32_t vertex : scene.triangles[triangle]) {
    magnitude = std::max(magnitude, std::abs(double{scene.attributes_of(vertex)[attribute]}));
  }
  constexpr int kLeastExponent = -126;
  constexpr int kFractionBits = 23;
  const int exponent =
      magnitude > 0 ? std::max(std::ilogb(magnitude), kLeastExponent) : kLeastExponent;
  return std::ldexp(1.0, exponent - kFractionBits);
}

/// Collects the judge's results for the visible fragments.
class Reader {
 public:
  Reader(const DrawnScene& drawn, const Seen& seen, const ErrorUnit& unit)
      : scene_(&drawn.scene), seen_(&seen), unit_(unit) {
    const cases::FramebufferSize& size = scene_->framebuffer;
    const std::size_t pixels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    map_ = {size.width, size.height, {}, {}};
    map_.states.resize(pixels, PixelState::empty);
    map_.errors.resize(pixels, 0);
  }

  void see_coverage(const oracle::JudgedSample& sample) {
    if (sample.fragment_class == records::FragmentClass::correct) return;
    ++violations_;
    if (seen_->has(sample.place.x, sample.place.y, sample.place.sample)) {
      map_.states[pixel_of(sample)] = PixelState::violated;
    }
  }

  void see_values(const oracle::JudgedSample& sample) {
    if (sample.values.empty() || !seen_->shows(sample)) return;
    const std::size_t pixel = pixel_of(sample);
    if (map_.states[pixel] == PixelState::empty) map_.states[pixel] = PixelState::correct;
    const double error = largest_error(sample);
    errors_.push_back(error);
    map_.errors[pixel] = std::max(map_.errors[pixel], static_cast<float>(error));
  }

  void finish(reports::GalleryPicture& picture) {
    std::sort(errors_.begin(), errors_.end());
    picture.errors = reports::draw_errors(map_, scene_->rules, *unit_.scale);
    picture.scale = unit_.scale;
    picture.samples = errors_.size();
    picture.violations = violations_;
    if (errors_.empty()) return;
    picture.worst = errors_.back();
    picture.p99 = errors_[(errors_.size() * 99 + 99) / 100 - 1];
  }

 private:
  std::size_t pixel_of(const oracle::JudgedSample& sample) const {
    return sample.place.y * static_cast<std::size_t>(map_.width) + sample.place.x;
  }

  /// Returns the largest error of a sample's attributes, in the picture's unit.
  double largest_error(const oracle::JudgedSample& sample) const {
    double largest = 0;
    for (const oracle::JudgedValue& value : sample.values) {
      if (!value.attribute || !value.ideal) continue;
      const double ulps = records::magnitude_bound(*value.ideal);
      const double unit =
          unit_.per_one == 0
              ? 1
              : unit_.per_one * ulp_of(*scene_, sample.place.triangle, *value.attribute);
      largest = std::max(largest, ulps * unit);
    }
    return largest;
  }

  const cases::Case* scene_;
  const Seen* seen_;
  ErrorUnit unit_;
  records::ErrorMap map_;
  std::vector<double> errors_;
  std::size_t violations_ = 0;
};

/// Joins images of one size side by side.
Image side_by_side(const std::vector<const Image*>& images) {
  const int width = images.front()->width;
  Image all = Image::filled(width * static_cast<int>(images.size()), images.front()->height,
                            reports::kUndrawn);
  int left = 0;
  for (const Image* image : images) {
    for (int row = 0; row < image->height; ++row) {
      for (int column = 0; column < width; ++column) {
        all.set(left + column, row, image->at(column, row));
      }
    }
    left += width;
  }
  return all;
}

}  // namespace

ErrorUnit in_ulp() { return {&reports::ulp_scale(), 0}; }
ErrorUnit in_texels() { return {&reports::texel_scale(), kTexels}; }
ErrorUnit in_levels() { return {&reports::level_scale(), 255}; }

Result<reports::GalleryPicture> judged_picture(const DrawnScene& drawn, const Shader& shader,
                                               const ErrorUnit& unit) {
  reports::GalleryPicture picture;
  picture.method = drawn.method;
  picture.missing = drawn.missing;
  picture.scale = unit.scale;
  if (!drawn.missing.empty()) return picture;
  const Seen seen(drawn, shader);
  picture.picture = seen.picture();

  // Compares coverage with what the method promises, but values always with the exact triangle:
  // laws check what the method promises for values.
  Reader reader(drawn, seen, unit);
  oracle::JudgeOptions coverage_only;
  coverage_only.judges_values = false;
  const oracle::SceneTruth promised(drawn.scene, drawn.contract);
  const oracle::JudgedDrawing covered = oracle::judge(
      promised, drawn.fragments, coverage_only,
      [&reader](const oracle::JudgedSample& sample, const oracle::TriangleTruth* /*truth*/) {
        reader.see_coverage(sample);
      });
  const oracle::SceneTruth exact(drawn.scene, cases::contract_of(drawn.scene));
  const oracle::JudgedDrawing judged = oracle::judge(
      exact, drawn.fragments, {},
      [&reader](const oracle::JudgedSample& sample, const oracle::TriangleTruth* /*truth*/) {
        reader.see_values(sample);
      });
  for (const auto& fault : {covered.fault, judged.fault}) {
    if (fault) return tl::unexpected(Error{"the oracle", "", *fault});
  }
  reader.finish(picture);
  return picture;
}

Result<reports::GalleryPicture> draw_panel(const PanelPlan& plan) {
  const Result<DrawnScene> drawn = draw_by(plan.method, plan.scene);
  if (!drawn) return tl::unexpected(drawn.error());
  Result<reports::GalleryPicture> picture = judged_picture(*drawn, plan.shader, plan.unit);
  if (!picture) return picture;
  picture->name = plan.name;
  picture->title = plan.title;
  return picture;
}

Result<reports::GalleryFigure> with_panels(reports::GalleryFigure figure,
                                           std::span<const PanelPlan> plans) {
  for (const PanelPlan& plan : plans) {
    Result<reports::GalleryPicture> picture = draw_panel(plan);
    if (!picture) return tl::unexpected(picture.error());
    figure.pictures.push_back(*std::move(picture));
  }
  return figure;
}

reports::GalleryPicture strip_of(std::span<const reports::GalleryPicture> frames) {
  reports::GalleryPicture strip = frames.front();
  if (!strip.missing.empty()) return strip;
  std::vector<const Image*> pictures;
  std::vector<const Image*> errors;
  strip.samples = 0;
  strip.violations = 0;
  for (const reports::GalleryPicture& frame : frames) {
    pictures.push_back(&frame.picture);
    errors.push_back(&frame.errors);
    strip.worst = std::max(strip.worst, frame.worst);
    strip.p99 = std::max(strip.p99, frame.p99);
    strip.samples += frame.samples;
    strip.violations += frame.violations;
  }
  strip.frames = static_cast<int>(frames.size());
  strip.picture = side_by_side(pictures);
  strip.errors = side_by_side(errors);
  return strip;
}

}  // namespace rastercheck::gallery

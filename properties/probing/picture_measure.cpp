// Measures how fragments become a picture. Every exact number is made of what the backend itself
// draws into float32 without blending, so that errors of values do not count as errors of pictures.
//
// Bytes: a colour c that is drawn as byte k shows k − 255 c. Its range tells the rounding: ±1/2 is
// the nearest byte, −1 to 0 the lower one. Half of the colours are near the middle between two
// bytes; some lie beyond 0 and 1, where the nearest byte is 0 or 255.
//
// Blends: draws triangles over others. What is present is read from a picture of those others
// alone, and the colours that come from a picture without blending.
//
// Resolve: draws the samples of steep triangles one by one and resolved. Bytes that may each be
// rounded on the way show errors of up to a step for each halving of the number of samples.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "properties/float_numbers.h"
#include "properties/probing/depth_planes.h"
#include "properties/probing/measures.h"
#include "properties/probing/picture_cells.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::Blend;
using cases::ColorFormat;
using cases::PictureBounds;

constexpr std::size_t kAlphaChannel = 3;
constexpr int kByteBits = 8;
/// A product with 255 and the addition of 1/2, each rounded to a float32 below 2^8.
constexpr double kByteSlack = 2 * 0x1p-17;
/// Four operations in double, of numbers below 2^9.
constexpr double kDoubleSlack = 4 * 0x1p-45;

// --- Bytes ---------------------------------------------------------------------------------------

/// Numbers that became bytes or floats, and how far these are off.
struct ColorErrors {
  ErrorRange errors;         ///< in steps of a byte, or in units of 2^-24 of the summed sizes
  std::uint64_t kept = 0;    ///< within what is declared
  std::uint64_t beyond = 0;  ///< not within
  std::uint64_t no_bytes = 0;
  std::uint64_t nearest_floats = 0;

  std::uint64_t all() const { return kept + beyond + no_bytes; }
  void count(bool is_kept) { ++(is_kept ? kept : beyond); }
};

/// Adds a colour that should be `exact` steps of 1/255.
void add_byte(ColorErrors& errors, float drawn, double exact, double limit) {
  const std::optional<std::uint32_t> k = number_of_depth(drawn, kByteBits);
  if (!k) {
    ++errors.no_bytes;
    return;
  }
  const double error = *k - exact;
  errors.errors.add(error);
  errors.count(std::fabs(error) <= limit + kDoubleSlack);
}

/// `limit` is declared: the largest distance in steps.
void add_byte_row(Subject& subject, const std::string& what, bool has_bounds, double limit,
                  const ColorErrors& seen) {
  const std::string declared = has_bounds ? "within " + step_words(limit) : "the nearest";
  if (seen.all() == 0) {
    subject.add(what, declared, kNotDrawn);
    return;
  }
  std::string measured =
      rounding_words(seen.errors, kByteSlack)
          .value_or(fmt::format("up to {} off", step_words(seen.errors.reach())));
  if (seen.no_bytes > 0) measured = "not stored in bytes";
  subject
      .add(what, declared, measured,
           fmt::format("{:.3f} to {:.3f} steps off", seen.errors.least, seen.errors.greatest),
           sure_of("colours", seen.kept, seen.beyond + seen.no_bytes))
      .contradicts = seen.kept != seen.all();
}

/// A colour whose product with 255 is, if asked, near the middle between two integers.
float unstored_color(Draw& draw, bool near_half) {
  constexpr int kTries = 1000;
  constexpr double kNearHalf = 1.0 / 16;
  float color = 0;
  for (int i = 0; i < kTries; ++i) {
    color = draw.unit();
    const double steps = kByteSteps * double{color};
    if (!near_half || std::fabs(steps - std::floor(steps) - 0.5) < kNearHalf) break;
  }
  return color;
}

std::vector<CellColor> colors_to_store(const Subject& subject) {
  MeasureDraw draw(subject, "storing in bytes");
  std::vector<CellColor> all{{0, 0.5F, 1, 1}, {-0.25F, 1.5F, 0.5F, 2}};
  while (all.size() < kColorCells) {
    CellColor color{};
    for (float& channel : color) channel = unstored_color(draw, all.size() % 2 == 0);
    all.push_back(color);
  }
  return all;
}

void measure_storing(Subject& subject) {
  const cases::Case c = case_of_cells(subject, colors_to_store(subject));
  const std::optional<PictureBounds> bounds = declared_bounds(subject, c);
  const double limit = bounds ? double{bounds->byte_store} : 0.5;
  const auto exact = subject.draw_picture(c, plain_pipeline());
  const auto stored = subject.draw_picture(c, plain_pipeline(ColorFormat::rgba8));
  ColorErrors seen;
  for (std::size_t cell = 0; exact && stored && cell < kColorCells; ++cell) {
    const auto [x, y] = pixel_of_cell(cell);
    if (!is_drawn(*exact, x, y) || !is_drawn(*stored, x, y)) continue;
    for (std::size_t channel = 0; channel < stored->channels; ++channel) {
      const double color = std::clamp(double{color_at(*exact, x, y, channel)}, 0.0, 1.0);
      add_byte(seen, color_at(*stored, x, y, channel), kByteSteps * color, limit);
    }
  }
  add_byte_row(subject, "storing in bytes", bounds.has_value(), limit, seen);
}

// --- Blends --------------------------------------------------------------------------------------

/// The two products that a blend adds, for a colour in units of `scale` that is drawn over one that
/// is present.
struct Blended {
  double drawn = 0;
  double kept = 0;
  double sum() const { return drawn + kept; }
  double size() const { return std::fabs(drawn) + std::fabs(kept); }
};

Blended blended(Blend blend, std::size_t channel, const CellColor& color, double scale,
                double present) {
  const double own = scale * double{color[channel]};
  if (blend == Blend::additive) return {own, present};
  const double alpha = double{color[kAlphaChannel]};
  return {channel == kAlphaChannel ? own : alpha * own, (1 - alpha) * present};
}

/// Colours of which some sums exceed 1.
std::vector<CellColor> colors_to_blend(const Subject& subject, const char* which) {
  constexpr float kMost = 0.75F;
  MeasureDraw draw(subject, which);
  std::vector<CellColor> all(kColorCells);
  for (CellColor& color : all) {
    for (float& channel : color) channel = kMost * draw.unit();
  }
  return all;
}

/// Adds a float that should be the sum of numbers of this size; without bounds, the nearest float.
void add_float(ColorErrors& errors, float drawn, double exact, double size,
               const std::optional<PictureBounds>& bounds) {
  const double error = double{drawn} - exact;
  const bool is_nearest = drawn == static_cast<float>(exact);
  if (is_nearest) ++errors.nearest_floats;
  if (size > 0) errors.errors.add(error / (kFloatUnit * size));
  errors.count(is_within(drawn, exact, bounds ? float_slack(*bounds, size) : 0));
}

void add_float_row(Subject& subject, const std::string& what,
                   const std::optional<PictureBounds>& bounds, const ColorErrors& seen) {
  if (seen.all() == 0) {
    subject.add(what, float_words(bounds), kNotDrawn);
    return;
  }
  const bool are_nearest = seen.nearest_floats == seen.all();
  const std::string off =
      fmt::format("up to {:.3g} · 2^-24 of the summed sizes off", seen.errors.reach());
  subject
      .add(what, float_words(bounds), are_nearest ? "the nearest float" : off,
           are_nearest ? off : "", sure_of("colours", seen.kept, seen.beyond))
      .contradicts = seen.beyond > 0;
}

struct BlendNames {
  Blend blend;
  const char* in_bytes;
  const char* in_floats;
};

/// Draws one blend into one format, and adds its row.
void measure_blend(Subject& subject, const BlendNames& names, ColorFormat format) {
  const bool is_bytes = format == ColorFormat::rgba8;
  const cases::Case below = case_of_cells(subject, colors_to_blend(subject, "blends, below"));
  const std::vector<CellColor> over = colors_to_blend(subject, "blends, over");
  const cases::Case above = case_of_cells(subject, over);
  cases::Case both = below;
  for (std::size_t i = 0; i < over.size(); ++i) add_cell(both, i, {over[i], over[i], over[i]});
  cases::Pipeline pipeline = plain_pipeline(format);
  pipeline.blend = names.blend;
  const auto present = subject.draw_picture(below, pipeline);
  const auto colors = subject.draw_picture(above, plain_pipeline());
  const auto drawn = subject.draw_picture(both, pipeline);
  const std::optional<PictureBounds> bounds = declared_bounds(subject, both);
  const double byte_limit = bounds ? double{bounds->byte_blend} : 0.5;
  const double scale = is_bytes ? kByteSteps : 1;
  ColorErrors seen;
  for (std::size_t cell = 0; present && colors && drawn && cell < kColorCells; ++cell) {
    const auto [x, y] = pixel_of_cell(cell);
    if (!is_drawn(*present, x, y) || !is_drawn(*colors, x, y)) continue;
    CellColor color{};
    for (std::size_t a = 0; a < color.size(); ++a) color[a] = color_at(*colors, x, y, a);
    for (std::size_t a = 0; a < color.size(); ++a) {
      double before = double{color_at(*present, x, y, a)};
      if (is_bytes) before = std::round(kByteSteps * before);
      const Blended exact = blended(names.blend, a, color, scale, before);
      const float after = color_at(*drawn, x, y, a);
      if (is_bytes) {
        add_byte(seen, after, std::min(exact.sum(), kByteSteps), byte_limit);
      } else {
        add_float(seen, after, exact.sum(), exact.size(), bounds);
      }
    }
  }
  if (is_bytes) {
    add_byte_row(subject, names.in_bytes, bounds.has_value(), byte_limit, seen);
  } else {
    add_float_row(subject, names.in_floats, bounds, seen);
  }
}

// --- Resolve -------------------------------------------------------------------------------------

/// Steep triangles, so that the samples of a pixel have different colours.
cases::Case steep_case(const Subject& subject, int samples) {
  MeasureDraw draw(subject, "resolve");
  cases::Case c = case_without_cells(subject, samples);
  for (std::size_t cell = 0; cell < kColorCells; ++cell) {
    std::array<CellColor, 3> colors{};
    for (CellColor& color : colors) {
      for (float& channel : color) channel = draw.unit();
    }
    add_cell(c, cell, colors);
  }
  return c;
}

/// What a pixel's samples became.
struct ResolveReading {
  ColorErrors errors;            ///< against the mean
  int halvings = 0;              ///< how often the greatest number of samples can be halved
  double most_samples = 0;       ///< the greatest number
  bool is_within = true;         ///< never beyond the samples' least and greatest
  std::vector<bool> are_sample;  ///< [sample] always that sample's colour
  std::string counts;            ///< the numbers of samples that were drawn
  /// The promise about the greatest number of samples; empty: all is kept to the bit.
  std::optional<PictureBounds> declared;
};

/// Reads one channel of a pixel.
void read_resolved(const std::vector<double>& samples, float drawn, ColorFormat format,
                   const std::optional<PictureBounds>& bounds, ResolveReading& reading) {
  const bool is_bytes = format == ColorFormat::rgba8;
  const auto n = static_cast<double>(samples.size());
  double sum = 0;
  double size = 0;
  for (const double sample : samples) {
    sum += sample;
    size += std::fabs(sample);
  }
  const auto [least, greatest] = std::minmax_element(samples.begin(), samples.end());
  const double scale = is_bytes ? kByteSteps : 1;
  const double color = is_bytes ? std::round(scale * double{drawn}) : double{drawn};
  const bool is_within = *least <= color && color <= *greatest;
  reading.is_within = reading.is_within && is_within;
  reading.are_sample.resize(std::max(reading.are_sample.size(), samples.size()), true);
  for (std::size_t i = 0; i < reading.are_sample.size(); ++i) {
    if (i >= samples.size() || samples[i] != color) reading.are_sample[i] = false;
  }
  ColorErrors one;
  if (is_bytes) {
    add_byte(one, drawn, sum / n, bounds ? double{bounds->byte_mean} : 0.5);
  } else {
    add_float(one, drawn, sum / n, size / n, bounds);
  }
  if (bounds && !bounds->resolves_to_mean && one.no_bytes == 0) {
    one.kept = is_within ? 1 : 0;
    one.beyond = is_within ? 0 : 1;
  }
  reading.errors.errors.add(one.errors.least);
  reading.errors.errors.add(one.errors.greatest);
  reading.errors.kept += one.kept;
  reading.errors.beyond += one.beyond;
  reading.errors.no_bytes += one.no_bytes;
  reading.errors.nearest_floats += one.nearest_floats;
}

/// Draws one number of samples; returns false if that is not drawn.
void read_resolve(Subject& subject, int samples, ColorFormat format, ResolveReading& reading) {
  const cases::Case c = steep_case(subject, samples);
  const std::optional<PictureBounds> bounds = declared_bounds(subject, c);
  cases::Pipeline pipeline = plain_pipeline(format);
  const auto each = subject.draw_picture(c, pipeline);
  pipeline.resolves = true;
  const auto resolved = subject.draw_picture(c, pipeline);
  if (!each || !resolved) return;
  reading.halvings = std::max(reading.halvings, exponent_of(samples));
  reading.most_samples = std::max(reading.most_samples, double(samples));
  reading.counts += fmt::format("{}{}", reading.counts.empty() ? "" : ", ", samples);
  reading.declared = bounds;  // numbers of samples ascend
  for (std::size_t cell = 0; cell < kColorCells; ++cell) {
    const auto [x, y] = pixel_of_cell(cell);
    const auto count = static_cast<std::size_t>(samples);
    std::size_t covered = 0;
    for (std::size_t i = 0; i < count; ++i) covered += is_drawn(*each, x, y, i) ? 1U : 0U;
    if (covered < count) continue;
    for (std::size_t channel = 0; channel < each->channels; ++channel) {
      std::vector<double> colors;
      for (std::size_t i = 0; i < count; ++i) {
        const double color = double{color_at(*each, x, y, channel, i)};
        colors.push_back(format == ColorFormat::rgba8 ? std::round(kByteSteps * color) : color);
      }
      read_resolved(colors, color_at(*resolved, x, y, channel), format, bounds, reading);
    }
  }
}

std::string mean_words(const ResolveReading& reading, ColorFormat format) {
  const double reach = reading.errors.errors.reach();
  if (format == ColorFormat::rgba8) {
    if (reading.errors.no_bytes > 0) return "not stored in bytes";
    if (const auto rounding = rounding_words(reading.errors.errors, kDoubleSlack)) {
      return "the mean: " + *rounding;
    }
    // Each mean of two numbers may be rounded to either neighbour.
    if (reach <= reading.halvings) return fmt::format("the mean: up to {} off", step_words(reach));
  } else {
    if (reading.errors.nearest_floats == reading.errors.all()) return "the mean: the nearest float";
    // n − 1 sums, each of parts of the samples, and a product.
    if (reach <= reading.most_samples) return "the mean";
  }
  for (std::size_t i = 0; i < reading.are_sample.size(); ++i) {
    if (reading.are_sample[i]) return fmt::format("sample {}", i);
  }
  return reading.is_within ? "between the least and the greatest" : "beyond the samples";
}

std::string declared_mean(const std::optional<PictureBounds>& bounds, bool is_bytes) {
  if (bounds && !bounds->resolves_to_mean) return "between the least and the greatest";
  if (!bounds && is_bytes) return "the mean: the nearest";
  return "the mean: " +
         (is_bytes ? "within " + step_words(double{bounds->byte_mean}) : float_words(bounds));
}

void measure_resolve(Subject& subject, ColorFormat format) {
  const bool is_bytes = format == ColorFormat::rgba8;
  const std::string what = fmt::format("resolve of {}", is_bytes ? "bytes" : "float32");
  ResolveReading reading;
  for (const int samples : subject.capabilities().sample_counts) {
    if (samples > 1) read_resolve(subject, samples, format, reading);
  }
  if (reading.errors.all() == 0) {
    subject.add(what, kNotDeclared, kNotDrawn, "no pictures of several samples per pixel");
    return;
  }
  const ErrorRange& errors = reading.errors.errors;
  std::string off = fmt::format("{:.3f} to {:.3f} steps", errors.least, errors.greatest);
  if (!is_bytes) off = fmt::format("up to {:.3g} · 2^-24 of the mean size", errors.reach());
  subject
      .add(what, declared_mean(reading.declared, is_bytes), mean_words(reading, format),
           fmt::format("{} from the mean, of {} samples", off, reading.counts),
           sure_of("colours", reading.errors.kept, reading.errors.beyond + reading.errors.no_bytes))
      .contradicts = reading.errors.kept != reading.errors.all();
}

}  // namespace

void measure_pictures(Subject& subject) {
  if (!subject.draws_pictures()) {
    subject.add("pictures", kNotDeclared, "not measured", "the backend draws no pictures");
    return;
  }
  measure_differences(subject);
  measure_storing(subject);
  for (const BlendNames& names :
       {BlendNames{Blend::over, "blending over in bytes", "blending over in float32"},
        BlendNames{Blend::additive, "adding in bytes", "adding in float32"}}) {
    measure_blend(subject, names, ColorFormat::rgba8);
    measure_blend(subject, names, ColorFormat::float32);
  }
  measure_resolve(subject, ColorFormat::rgba8);
  measure_resolve(subject, ColorFormat::float32);
}

}  // namespace rastercheck::properties

// Measures the weights of bilinear filtering, and where nearest filtering changes from one texel to
// the next. Coordinates count as the backend draws them into a picture without a texture.
//
// Weights: a texture of two texels, 0 and 1, shows the weight of the second one as its colour. The
// coordinate changes slowly from the first texel's centre to the second one's, so weights of n bits
// show as colours that are multiples of 2^-n. Filters that also round colours to bytes show
// multiples of 1/255.
//
// Borders: coordinates are the same all over a triangle, and lie some floats before or beyond a
// border k/width. The first picture tries powers of two of floats, up to half a texel; each further
// one tries floats between the farthest that is on the wrong side and the nearest that is not.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "properties/float_numbers.h"
#include "properties/probing/measures.h"
#include "properties/probing/picture_cells.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

constexpr std::size_t kTexelChannels = 4;

cases::Texturing one_row(const std::vector<std::uint8_t>& bytes, cases::Filter filter) {
  cases::Texturing texturing;
  texturing.texture.width = static_cast<int>(bytes.size());
  texturing.texture.height = 1;
  for (const std::uint8_t byte : bytes) {
    texturing.texture.texels.insert(texturing.texture.texels.end(), kTexelChannels, byte);
  }
  texturing.wrap_s = cases::Wrap::clamp;
  texturing.wrap_t = cases::Wrap::clamp;
  texturing.filter = filter;
  return texturing;
}

/// The middle of a texture's only row.
constexpr float kMiddle = 0.5F;

// --- Weights -------------------------------------------------------------------------------------

/// The greatest number of bits that is tried. Other weights lie within kWeightRounding of a
/// multiple of 2^-16 once in 32 times.
constexpr int kMostWeightBits = 16;
/// The filter's three interpolations a + f (b − a) of numbers up to 1, each of two operations.
constexpr double kWeightRounding = 6 * 0x1p-25;

struct Weight {
  double exact = 0;
  double drawn = 0;
};

/// A triangle over half of the window, whose coordinate s goes from 1/4 to 3/4 by steps that belong
/// to no grid.
cases::Case slow_case(const Subject& subject) {
  constexpr float kShare = 1.0F / 128;  // of the texture
  MeasureDraw draw(subject, "filter weights");
  cases::Case c = case_without_cells(subject);
  const double side = c.framebuffer.width;
  add_triangle(c, at_window(c, {0, 0}, 0.5F, 1), at_window(c, {side, 0}, 0.5F, 1),
               at_window(c, {0, side}, 0.5F, 1));
  const float first = 0.25F + kShare * draw.unit();
  const float along_x = 0.75F - kShare * draw.unit();
  const float along_y = 0.25F + 2 * kShare + kShare * draw.unit();
  for (const float s : {first, along_x, along_y}) {
    c.attribute_values.insert(c.attribute_values.end(), {s, kMiddle, 0, 0});
  }
  return c;
}

std::vector<Weight> read_weights(Subject& subject, const cases::Case& c) {
  cases::Pipeline pipeline = plain_pipeline();
  const auto coordinates = subject.draw_picture(c, pipeline);
  pipeline.texturing = one_row({0, 255}, cases::Filter::bilinear);
  const auto drawn = subject.draw_picture(c, pipeline);
  std::vector<Weight> weights;
  if (!coordinates || !drawn) return weights;
  for (std::size_t y = 0; y < static_cast<std::size_t>(c.framebuffer.height); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(c.framebuffer.width); ++x) {
      if (!is_drawn(*coordinates, x, y) || !is_drawn(*drawn, x, y)) continue;
      const double s = double{color_at(*coordinates, x, y, 0)};
      weights.push_back({2 * s - 0.5, double{color_at(*drawn, x, y, 0)}});
    }
  }
  return weights;
}

/// How many weights are multiples of 1/parts, within float rounding.
std::uint64_t multiples_of(const std::vector<Weight>& weights, double parts) {
  return static_cast<std::uint64_t>(
      std::count_if(weights.begin(), weights.end(), [parts](const Weight& weight) {
        const double in_parts = weight.drawn * parts;
        return std::fabs(in_parts - std::round(in_parts)) <= kWeightRounding * parts;
      }));
}

/// A grid that all weights lie on.
struct WeightGrid {
  double parts = 1;          ///< multiples of 1/parts
  double coarser_parts = 1;  ///< of the next grid, on which they do not all lie
  std::string words;
};

std::optional<WeightGrid> grid_of(const std::vector<Weight>& weights) {
  if (multiples_of(weights, 1) == weights.size()) {
    return WeightGrid{1, 1, "0 and 1 only: not filtered"};
  }
  for (int bits = 1; bits <= kMostWeightBits; ++bits) {
    const double parts = std::ldexp(1.0, bits);
    if (multiples_of(weights, parts) == weights.size()) {
      return WeightGrid{parts, parts / 2, fmt::format("multiples of 2^-{}", bits)};
    }
  }
  if (multiples_of(weights, kByteSteps) == weights.size()) {
    return WeightGrid{kByteSteps, 1, "multiples of 1/255"};
  }
  return std::nullopt;
}

/// The largest error of a bilinear colour that is declared (cases::TextureBounds); empty if none
/// is.
std::optional<double> filter_limit(Subject& subject, const cases::Case& c) {
  const auto bounds = subject.backend().promise(c).texture_bounds;
  if (!bounds) return std::nullopt;
  double greatest = 0;
  for (std::size_t i = 0; i < c.attribute_values.size(); i += c.attributes.size()) {
    greatest = std::max(greatest, double{c.attribute_values[i]});
  }
  const double share = double{bounds->coordinate_share};
  const double constant = double{bounds->coordinate_constant};
  // The coordinates that are looked up need not be rounded to floats, as those that are drawn are.
  const double rounding = 2 * ulp_of(greatest);
  return 2 * (share * greatest + constant) + (share * double{kMiddle} + constant) +
         double{bounds->bilinear} * kFloatUnit + rounding;
}

void measure_weights(Subject& subject) {
  constexpr const char* kWhat = "weights of the bilinear filter";
  const cases::Case c = slow_case(subject);
  const std::optional<double> limit = filter_limit(subject, c);
  const std::string declared =
      limit ? fmt::format("within {:.3g} of the exact", *limit) : kNotDeclared;
  const std::vector<Weight> weights = read_weights(subject, c);
  if (weights.empty()) {
    subject.add(kWhat, declared, kNotDrawn);
    return;
  }
  ErrorRange errors;
  for (const Weight& weight : weights) errors.add(weight.drawn - weight.exact);
  std::string detail = fmt::format("up to {:.3g} off the exact weights", errors.reach());
  std::string measured = fmt::format("on no grid down to 2^-{}", kMostWeightBits);
  const std::optional<WeightGrid> grid = grid_of(weights);
  std::uint64_t coarser = multiples_of(weights, std::ldexp(1.0, kMostWeightBits));
  if (grid) {
    measured = grid->words;
    coarser = grid->parts == 1 ? 0 : multiples_of(weights, grid->coarser_parts);
    const ErrorRange steps{errors.least * grid->parts, errors.greatest * grid->parts};
    const double slack = kWeightRounding * grid->parts;
    if (const auto rounding = rounding_words(steps, slack)) detail += ", " + *rounding;
  }
  subject
      .add(kWhat, declared, measured, detail,
           sure_of("weights", weights.size() - coarser, 0, coarser))
      .contradicts = limit && errors.reach() > *limit;
}

// --- Borders -------------------------------------------------------------------------------------

/// A border between texels k − 1 and k of a texture, and which coordinates near it were drawn as
/// which of them. Steps are floats beyond that nearest to the border.
struct Border {
  int width = 1;
  int k = 0;
  /// True of the steps at which texel k was drawn.
  std::map<int, bool> is_beyond = {};
  double early = 0;        ///< how far before the border texel k is drawn, in texels
  double late = 0;         ///< how far beyond it texel k − 1 is drawn
  double early_steps = 0;  ///< both in float32 steps of the coordinate
  double late_steps = 0;
  std::optional<bool> owner_is_beyond = {};  ///< at the border itself
  std::uint64_t right = 0;
  std::uint64_t wrong = 0;   ///< on the wrong side, farther away than is declared
  std::uint64_t others = 0;  ///< another texel's colour

  float nearest() const { return to_float(double(k) / width); }
};

/// The byte of a texel; texels of one texture have different bytes.
std::uint8_t byte_of_texel(int index) { return static_cast<std::uint8_t>(4 * index + 3); }

cases::Texturing numbered_texels(int width) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width));
  for (int i = 0; i < width; ++i) bytes[static_cast<std::size_t>(i)] = byte_of_texel(i);
  return one_row(bytes, cases::Filter::nearest);
}

constexpr std::size_t kStepsOfBorder = 64;  ///< cells of a picture

/// The steps to try next: first powers of two up to half a texel, then some between those that were
/// tried on either side of the border; none if all that lie between were tried.
std::vector<int> steps_to_try(const Border& border) {
  std::vector<int> steps;
  if (border.is_beyond.empty()) {
    const double half_texel = 0.5 / border.width;
    steps.push_back(0);
    for (int step = 1; step * ulp_of(double{border.nearest()}) < half_texel; step *= 2) {
      steps.insert(steps.end(), {step, -step});
    }
    return steps;
  }
  // The choice changes somewhere between the last step of k − 1 and the first of k, or the reverse
  // if it changes several times.
  int last_before = border.is_beyond.begin()->first;
  int first_beyond = border.is_beyond.rbegin()->first;
  for (const auto& [step, is_beyond] : border.is_beyond) {
    if (!is_beyond) last_before = step;
    if (is_beyond) first_beyond = std::min(first_beyond, step);
  }
  const auto [from, to] = std::minmax(last_before, first_beyond);
  const int between = to - from - 1;
  const int count = std::min(between, static_cast<int>(kStepsOfBorder) - 1);
  for (int i = 1; i <= count; ++i) {
    const auto part = static_cast<std::int64_t>(to - from) * i / (count + 1);
    const int step = from + static_cast<int>(part);
    if (!border.is_beyond.contains(step)) steps.push_back(step);
  }
  return steps;
}

/// Reads a texel at a coordinate; `step` is how it was asked for. `share` and `distance` are
/// declared (cases::PictureBounds).
void read_choice(double coordinate, float color, int step, double share, double distance,
                 Border& border) {
  const double texel = (kByteSteps * double{color} - byte_of_texel(0)) / 4;
  // Colours k/255 are off by much less than a quarter of the difference of two texels.
  const bool is_either =
      std::fabs(texel - border.k) < 0.25 || std::fabs(texel - border.k + 1) < 0.25;
  if (!is_either || !std::isfinite(coordinate)) {
    ++border.others;
    return;
  }
  const bool is_beyond = std::lround(texel) == border.k;
  border.is_beyond[step] = is_beyond;
  // Exact: the coordinate has 24 bits, the width 6.
  const double off = coordinate * border.width - border.k;
  if (off == 0) border.owner_is_beyond = is_beyond;
  const double steps = std::fabs(off) / (border.width * ulp_of(coordinate));
  const bool is_early = is_beyond && off < 0;
  const bool is_late = !is_beyond && off > 0;
  if (is_early) {
    border.early = std::max(border.early, -off);
    border.early_steps = std::max(border.early_steps, steps);
  }
  if (is_late) {
    border.late = std::max(border.late, off);
    border.late_steps = std::max(border.late_steps, steps);
  }
  const double limit = share * std::fabs(coordinate * border.width) + distance;
  const bool is_wrong = (is_early || is_late) && std::fabs(off) > limit;
  ++(is_wrong ? border.wrong : border.right);
}

/// Draws the next steps of all borders, which belong to one texture; returns false if there are
/// none left or nothing was drawn.
bool draw_borders(Subject& subject, std::vector<Border>& borders) {
  struct Asked {
    std::size_t border = 0;
    int step = 0;
  };
  std::vector<Asked> asked;
  std::vector<CellColor> colors;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    for (const int step : steps_to_try(borders[i])) {
      asked.push_back({i, step});
      colors.push_back({stepped(borders[i].nearest(), step), kMiddle, 0, 0});
    }
  }
  if (asked.empty()) return false;
  const cases::Case c = case_of_cells(subject, colors);
  cases::Pipeline pipeline = plain_pipeline();
  const auto coordinates = subject.draw_picture(c, pipeline);
  pipeline.texturing = numbered_texels(borders.front().width);
  const auto drawn = subject.draw_picture(c, pipeline);
  if (!coordinates || !drawn) return false;
  const std::optional<cases::PictureBounds> bounds = declared_bounds(subject, c);
  const double share = bounds ? double{bounds->texel_share} : 0;
  const double distance = bounds ? double{bounds->texel_distance} : 0;
  bool is_any_drawn = false;
  for (std::size_t cell = 0; cell < asked.size(); ++cell) {
    const auto [x, y] = pixel_of_cell(cell);
    if (!is_drawn(*coordinates, x, y) || !is_drawn(*drawn, x, y)) continue;
    is_any_drawn = true;
    read_choice(double{color_at(*coordinates, x, y, 0)}, color_at(*drawn, x, y, 0),
                asked[cell].step, share, distance, borders[asked[cell].border]);
  }
  return is_any_drawn;
}

/// Borders of two textures, of which one has a width that is no power of two; the coordinates of
/// most of its borders are no floats.
std::vector<Border> read_borders(Subject& subject) {
  // Half a texel is 2^22 floats at most, and each picture of 64 steps leaves a 64th of them.
  constexpr int kMostPictures = 5;
  std::vector<Border> all;
  for (std::vector<Border> borders : {std::vector<Border>{{16, 1}, {16, 5}, {16, 11}, {16, 15}},
                                      std::vector<Border>{{48, 1}, {48, 16}, {48, 25}, {48, 47}}}) {
    for (int i = 0; i < kMostPictures && draw_borders(subject, borders); ++i) continue;
    all.insert(all.end(), borders.begin(), borders.end());
  }
  return all;
}

/// True if texels are promised to be those of the exact coordinates.
bool is_exact(const std::optional<cases::PictureBounds>& bounds) {
  return !bounds || (bounds->texel_share == 0 && bounds->texel_distance == 0);
}

void add_choice_row(Subject& subject, const std::optional<cases::PictureBounds>& bounds,
                    const std::vector<Border>& borders) {
  const std::string declared =
      is_exact(bounds) ? "exact"
                       : fmt::format("within {:.3g} texels and {:.3g} of the coordinate",
                                     bounds->texel_distance, bounds->texel_share);
  Border most;
  for (const Border& border : borders) {
    most.early = std::max(most.early, border.early);
    most.late = std::max(most.late, border.late);
    most.early_steps = std::max(most.early_steps, border.early_steps);
    most.late_steps = std::max(most.late_steps, border.late_steps);
    most.right += border.right;
    most.wrong += border.wrong;
    most.others += border.others;
  }
  std::string measured = "exact";
  std::string detail;
  const auto add = [&](double texels, double steps, const char* side) {
    if (texels == 0) return;
    measured = measured == "exact" ? "" : measured + ", ";
    measured += fmt::format("up to {:.3g} texels {}", texels, side);
    detail +=
        fmt::format("{}{:.3g} float32 steps {}", detail.empty() ? "up to " : ", ", steps, side);
  };
  add(most.early, most.early_steps, "early");
  add(most.late, most.late_steps, "late");
  if (most.others > 0) measured = "other texels";
  subject
      .add("texel choice near borders", declared, measured, detail,
           sure_of("coordinates", most.right, most.wrong + most.others))
      .contradicts = most.wrong + most.others > 0;
}

void add_owner_row(Subject& subject, const std::optional<cases::PictureBounds>& bounds,
                   const std::vector<Border>& borders) {
  std::uint64_t beyond = 0;
  std::uint64_t before = 0;
  for (const Border& border : borders) {
    if (!border.owner_is_beyond) continue;
    ++(*border.owner_is_beyond ? beyond : before);
  }
  constexpr const char* kWhat = "texel at a border";
  constexpr const char* kBeyond = "the one beyond";
  const char* const declared = is_exact(bounds) ? kBeyond : "either";
  if (beyond + before == 0) {
    subject.add(kWhat, declared, kNotDrawn, "no coordinate is exactly on a border");
    return;
  }
  const char* const measured = before == 0 ? kBeyond : beyond == 0 ? "the one before" : "either";
  const bool are_most_beyond = beyond >= before;
  subject
      .add(kWhat, declared, measured, "",
           sure_of("borders", are_most_beyond ? beyond : before, are_most_beyond ? before : beyond))
      .contradicts = is_exact(bounds) && before > 0;
}

void measure_borders(Subject& subject) {
  const std::vector<Border> borders = read_borders(subject);
  const auto bounds = declared_bounds(subject, case_without_cells(subject));
  const bool is_any = std::any_of(borders.begin(), borders.end(), [](const Border& border) {
    return border.right + border.wrong + border.others > 0;
  });
  if (!is_any) {
    subject.add("texel choice near borders", kNotDeclared, kNotDrawn);
    return;
  }
  add_choice_row(subject, bounds, borders);
  add_owner_row(subject, bounds, borders);
}

}  // namespace

void measure_textures(Subject& subject) {
  if (!subject.draws_pictures()) {
    subject.add("textures", kNotDeclared, "not measured", "the backend draws no pictures");
    return;
  }
  measure_weights(subject);
  measure_borders(subject);
}

}  // namespace rastercheck::properties

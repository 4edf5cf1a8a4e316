// Measures whether a picture has the fragments that the backend draws alone, and what it shows of
// differences across quads.
//
// A triangle whose w differs between its vertices has other differences in one row of a quad than
// in the other row. A backend that shows one row's difference in both rows is called coarse. The
// exact differences are those of the values that a picture without differences shows.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "properties/float_numbers.h"
#include "properties/probing/depth_planes.h"
#include "properties/probing/picture_cells.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::PictureBounds;

// --- Fragments -----------------------------------------------------------------------------------

/// A triangle over half of the window, with other values and another w at each vertex.
cases::Case perspective_case(const Subject& subject) {
  MeasureDraw draw(subject, "differences across quads");
  cases::Case c = case_without_cells(subject);
  const double side = c.framebuffer.width;
  add_triangle(c, at_window(c, {0, 0}, 0.5F, 1), at_window(c, {side, 0}, 0.5F, 2),
               at_window(c, {0, side}, 0.5F, 4));
  for (std::size_t i = 0; i < c.positions.size() * c.attributes.size(); ++i) {
    c.attribute_values.push_back(draw.unit());
  }
  return c;
}

/// Compares the attributes and depths of a picture with those of fragments.
void add_fragments_row(Subject& subject, const cases::Case& c, const cases::Picture& picture) {
  const std::string what = "fragments of pictures";
  const std::optional<PictureBounds> bounds = declared_bounds(subject, c);
  const bool are_declared = !bounds || bounds->keeps_fragments;
  const char* const declared = are_declared ? "as drawn alone" : kNotDeclared;
  const auto fragments = subject.draw(c);
  if (!fragments || fragments->size() == 0) {
    subject.add(what, declared, kNotDrawn);
    return;
  }
  std::uint64_t same = 0;
  for (std::size_t i = 0; i < fragments->size(); ++i) {
    const auto values = fragments->attributes_of(i);
    const std::size_t x = fragments->x[i];
    const std::size_t y = fragments->y[i];
    bool is_same =
        picture.depth[y * static_cast<std::size_t>(c.framebuffer.width) + x] == fragments->depth[i];
    for (std::size_t a = 0; a < values.size(); ++a) {
      is_same = is_same && color_at(picture, x, y, a) == values[a];
    }
    if (is_same) ++same;
  }
  const std::uint64_t others = fragments->size() - same;
  subject
      .add(what, declared, others == 0 ? "as drawn alone" : "other values or depths", "",
           sure_of("fragments", same, others))
      .contradicts = are_declared && others > 0;
}

// --- Differences across quads --------------------------------------------------------------------

/// What the pixels of quads show, by the parity of their row: of their column, for differences
/// along y.
struct DifferenceReading {
  std::array<std::uint64_t, 2> own{};    ///< that of the pixel's own row
  std::array<std::uint64_t, 2> other{};  ///< that of the other row
  std::uint64_t neither = 0;
  std::uint64_t undecided = 0;  ///< both rows' are about the same
  std::uint64_t beyond = 0;     ///< farther from its own row's than is declared
  double reach = 0;             ///< from its own row's, in units of 2^-24 of both values' sizes
  bool are_nearest = true;      ///< the nearest float to its own row's
  bool are_neighbors = true;    ///< at most a float away from it

  bool is_fine() const { return other[0] + other[1] + neither == 0; }
  std::uint64_t decided() const { return own[0] + own[1] + other[0] + other[1] + neither; }
};

/// How far differences may be from those of the values that are drawn, apart from a share of the
/// values' sizes, if the backend promises differences of the exact values (Contract::quad_share);
/// infinite if they do not bound that.
double open_difference(const cases::Contract& contract, const cases::Case& c) {
  if (!contract.quad_share || !contract.bounds.smooth.is_constant()) {
    return std::numeric_limits<double>::infinity();
  }
  constexpr double kMostOfW = 4;  // the greatest g: that of the vertices' w
  double most = 0;
  for (const float value : c.attribute_values) most = std::max(most, std::fabs(double{value}));
  // Both values that are drawn are off by their own bound.
  return double{*contract.quad_share} * (1 + kMostOfW) * most +
         2 * double{contract.bounds.smooth.constant} * ulp_of(most);
}

class QuadReader {
 public:
  QuadReader(const cases::Case& c, const cases::Contract& contract, const cases::Picture& values,
             const cases::Picture& differences, bool is_along_x)
      : bounds_(contract.picture_bounds),
        open_(open_difference(contract, c)),
        values_(&values),
        differences_(&differences),
        is_along_x_(is_along_x) {}

  DifferenceReading read() {
    const auto width = static_cast<std::size_t>(values_->size.width);
    const auto height = static_cast<std::size_t>(values_->size.height);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const std::size_t left = x & ~std::size_t{1};
        const std::size_t low = y & ~std::size_t{1};
        if (is_drawn(*values_, left, low) && is_drawn(*values_, left + 1, low) &&
            is_drawn(*values_, left, low + 1) && is_drawn(*values_, left + 1, low + 1)) {
          for (std::size_t a = 0; a < values_->channels; ++a) read(x, y, a);
        }
      }
    }
    return reading_;
  }

 private:
  struct Exact {
    double difference = 0;
    double size = 0;  ///< of both values
  };

  Exact difference_at(std::size_t x, std::size_t y, std::size_t channel) const {
    std::size_t& along = is_along_x_ ? x : y;
    along &= ~std::size_t{1};
    const double even = double{color_at(*values_, x, y, channel)};
    ++along;
    const double odd = double{color_at(*values_, x, y, channel)};
    return {odd - even, std::fabs(odd) + std::fabs(even)};
  }

  void read(std::size_t x, std::size_t y, std::size_t channel) {
    const Exact own = difference_at(x, y, channel);
    const Exact other =
        is_along_x_ ? difference_at(x, y ^ 1U, channel) : difference_at(x ^ 1U, y, channel);
    const double drawn = double{color_at(*differences_, x, y, channel)};
    const double off = std::fabs(drawn - own.difference);
    if (own.size > 0) reading_.reach = std::max(reading_.reach, off / (kFloatUnit * own.size));
    if (drawn != double{static_cast<float>(own.difference)}) reading_.are_nearest = false;
    if (!(off <= ulp_of(own.difference))) reading_.are_neighbors = false;
    const double slack = bounds_ ? float_slack(*bounds_, own.size) : open_;
    if (!is_within(color_at(*differences_, x, y, channel), own.difference, slack)) {
      ++reading_.beyond;
    }
    const std::size_t row = (is_along_x_ ? y : x) & 1U;
    if (std::fabs(own.difference - other.difference) <= 2 * kPlaneError) {
      ++reading_.undecided;
    } else if (off <= kPlaneError) {
      ++reading_.own[row];
    } else if (std::fabs(drawn - other.difference) <= kPlaneError) {
      ++reading_.other[row];
    } else {
      ++reading_.neither;
    }
  }

  std::optional<PictureBounds> bounds_;
  double open_;
  const cases::Picture* values_;
  const cases::Picture* differences_;
  bool is_along_x_;
  DifferenceReading reading_;
};

/// The quantity that most pixels show, in words, and how many of them do.
std::pair<std::string, std::uint64_t> difference_words(const DifferenceReading& reading,
                                                       bool is_along_x) {
  const char* const line = is_along_x ? "row" : "column";
  const std::uint64_t all = reading.decided();
  const std::uint64_t fine = reading.own[0] + reading.own[1];
  const std::uint64_t even = reading.own[0] + reading.other[1];
  const std::uint64_t odd = reading.own[1] + reading.other[0];
  if (fine == all) return {fmt::format("fine: each {} its own", line), fine};
  if (even == all) return {fmt::format("coarse: those of the even {}", line), even};
  if (odd == all) return {fmt::format("coarse: those of the odd {}", line), odd};
  return {"neither fine nor coarse", reading.neither};
}

void measure_along(Subject& subject, const cases::Case& c, const cases::Picture& values,
                   bool is_along_x) {
  const std::string what = fmt::format("differences along {}", is_along_x ? "x" : "y");
  const cases::Contract contract = subject.backend().promise(c);
  const std::optional<PictureBounds>& bounds = contract.picture_bounds;
  const bool are_declared = bounds ? bounds->keeps_fragments : contract.quad_share.has_value();
  std::string declared = are_declared ? "fine" : kNotDeclared;
  if (bounds && are_declared) declared += ": " + float_words(bounds);
  cases::Pipeline pipeline = plain_pipeline();
  pipeline.shading =
      is_along_x ? cases::Shading::differences_along_x : cases::Shading::differences_along_y;
  const auto drawn = subject.draw_picture(c, pipeline);
  if (!drawn) {
    subject.add(what, declared, kNotDrawn);
    return;
  }
  const DifferenceReading reading = QuadReader(c, contract, values, *drawn, is_along_x).read();
  if (reading.decided() == 0) {
    subject.add(what, declared, kNotDrawn, "no quad tells one row from the other");
    return;
  }
  const auto [words, in_favour] = difference_words(reading, is_along_x);
  std::string detail =
      fmt::format("up to {:.3g} · 2^-24 of the two values' sizes off", reading.reach);
  if (reading.are_neighbors) {
    detail = reading.are_nearest ? "the nearest floats to those of the values drawn"
                                 : "neighbours of those of the values drawn";
  }
  subject
      .add(what, declared, words, detail,
           sure_of("differences", in_favour, reading.decided() - in_favour, reading.undecided))
      .contradicts = are_declared && (reading.beyond > 0 || !reading.is_fine());
}

}  // namespace

void measure_differences(Subject& subject) {
  const cases::Case c = perspective_case(subject);
  const auto values = subject.draw_picture(c, plain_pipeline());
  if (!values) {
    subject.add("fragments of pictures", kNotDeclared, kNotDrawn);
    subject.add("differences across quads", kNotDeclared, kNotDrawn);
    return;
  }
  add_fragments_row(subject, c, *values);
  measure_along(subject, c, *values, true);
  measure_along(subject, c, *values, false);
}

}  // namespace rastercheck::properties

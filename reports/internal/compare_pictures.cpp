#include "reports/internal/compare_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "cases/float_text.h"
#include "records/histogram.h"
#include "reports/error_scale.h"
#include "reports/internal/canvas.h"
#include "reports/internal/crop_cells.h"
#include "reports/internal/html.h"
#include "reports/internal/log2.h"
#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Inspection;

/// The number of colours per octave of the scale.
constexpr int kStepsPerOctave = 2;
/// Maximum number of pixels listed.
constexpr std::size_t kMostListed = 5;

int steps() {
  return kStepsPerOctave * (ulp_scale().greatest_exponent - ulp_scale().least_exponent);
}

/// The CSS class for the colour of an error.
std::string step_class(double error) {
  const int most = steps();
  if (!(error > 0)) return "c0";
  if (std::isinf(error)) return fmt::format("c{}", most);
  const double step = kStepsPerOctave * (drawn_log2(error) - ulp_scale().least_exponent);
  return fmt::format(
      "c{}", static_cast<int>(std::lround(std::clamp(step, 0.0, static_cast<double>(most)))));
}

std::string size_text(double size) { return fmt::format("{:.3g}", size); }

/// How a picture shows one pixel.
struct ShownPixel {
  std::string style;  ///< its class; empty if the pixel is invisible
  std::string text;   ///< description in words
  bool has_cross = false;
};

ShownPixel shown_error(const std::optional<float>& value, const std::optional<double>& error) {
  if (!value) return {};
  if (error) return {step_class(*error), size_text(*error) + " ULP off"};
  if (!std::isfinite(*value)) return {"odd", fmt::format("{}", *value), true};
  return {"odd", "drawn, without an exact value", true};
}

ShownPixel shown_before(const CropCell& cell) {
  return shown_error(cell.before, cell.error_before);
}
ShownPixel shown_after(const CropCell& cell) { return shown_error(cell.after, cell.error_after); }

ShownPixel shown_change(const CropCell& cell) {
  if (!cell.change) return {};
  if (*cell.change == 0) return {"same", "same bits"};
  if (!cell.before) return {"odd", "drawn only now", true};
  if (!cell.after) return {"odd", "drawn only in the baseline", true};
  if (std::isinf(*cell.change)) return {"odd", "NaN or infinite in one drawing", true};
  return {step_class(*cell.change), size_text(*cell.change) + " ULP apart"};
}

// --- Pictures ------------------------------------------------------------------------------------

/// Maps window pixels to a picture.
class Frame {
 public:
  explicit Frame(const Inspection& inspection) : inspection_(&inspection) {}

  int column(std::uint32_t x) const { return static_cast<int>(x - inspection_->left); }
  int row(std::uint32_t y) const {
    return row_of(static_cast<int>(y - inspection_->top), static_cast<int>(inspection_->height),
                  inspection_->source.rules);
  }
  double across(double x) const { return x - inspection_->left; }
  double down(double y) const {
    const double from_top = y - inspection_->top;
    return inspection_->source.rules == cases::Rules::opengl ? inspection_->height - from_top
                                                             : from_top;
  }
  const Inspection& inspection() const { return *inspection_; }

 private:
  const Inspection* inspection_;
};

/// The outline of the triangle, and a mark at the inspected pixel.
std::string marks_of(const Frame& frame) {
  const Inspection& inspection = frame.inspection();
  std::string text;
  if (inspection.place.triangle < inspection.outlines.size()) {
    std::string points;
    for (const records::WindowPoint& point : inspection.outlines[inspection.place.triangle]) {
      points += fmt::format("{:.3f},{:.3f} ", frame.across(point.x), frame.down(point.y));
    }
    if (!points.empty()) text += fmt::format("<polygon points=\"{}\"/>", points);
  }
  return text + fmt::format("<path class=\"focus\" d=\"M{} {}h1v1h-1z\"/>",
                            frame.column(inspection.place.x), frame.row(inspection.place.y));
}

template <typename Show>
std::string picture(const Frame& frame, const std::vector<CropCell>& cells,
                    std::string_view caption, const std::string& label, const Show& show) {
  const Inspection& inspection = frame.inspection();
  std::string svg = fmt::format(
      "<figure><svg class=\"crop\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">",
      inspection.width, inspection.height, html(label));
  for (const CropCell& cell : cells) {
    const ShownPixel shown = show(cell);
    if (shown.style.empty()) continue;
    const int column = frame.column(cell.place.x);
    const int row = frame.row(cell.place.y);
    svg += fmt::format("<path class=\"{}\" d=\"M{} {}h1v1h-1z\"><title>({}, {}): {}</title></path>",
                       shown.style, column, row, cell.place.x, cell.place.y, shown.text);
    if (shown.has_cross) {
      svg += fmt::format("<path class=\"cross\" d=\"M{}.2 {}.2l.6 .6m0-.6l-.6 .6\"/>", column, row);
    }
  }
  return svg + marks_of(frame) +
         fmt::format("</svg><figcaption>{}</figcaption></figure>\n", caption);
}

/// The largest finite number of all cells; empty if no cell has one.
template <typename Number>
std::optional<double> largest(const std::vector<CropCell>& cells, const Number& number) {
  std::optional<double> most;
  for (const CropCell& cell : cells) {
    const std::optional<double> size = number(cell);
    if (size && std::isfinite(*size) && size > most) most = size;
  }
  return most;
}

std::string up_to(const std::optional<double>& most) {
  return most ? fmt::format("up to {} ULP", size_text(*most)) : std::string("no numbers to show");
}

/// "12 of 80 pixels that are drawn changed; 1 drawn in one of them only".
std::string change_summary(const std::vector<CropCell>& cells) {
  const auto count = [&cells](const auto& is_counted) {
    return static_cast<std::uint64_t>(std::count_if(cells.begin(), cells.end(), is_counted));
  };
  const auto drawn = count([](const CropCell& cell) { return cell.change.has_value(); });
  const auto changed = count([](const CropCell& cell) { return cell.change.value_or(0) > 0; });
  const auto once = count([](const CropCell& cell) {
    return cell.change && cell.before.has_value() != cell.after.has_value();
  });
  std::string text =
      fmt::format("{} of {} changed", changed, counted(drawn, "drawn pixel", "drawn pixels"));
  if (once > 0) text += fmt::format("; {} drawn in only one of them", once);
  return text;
}

std::string kept_pictures(const Frame& frame, const std::vector<CropCell>& cells) {
  const auto before = largest(cells, [](const CropCell& c) { return c.error_before; });
  const auto after = largest(cells, [](const CropCell& c) { return c.error_after; });
  const std::string changes = change_summary(cells);
  return picture(frame, cells, "Old: how far the baseline's values were off, " + up_to(before),
                 "Old errors, " + up_to(before), &shown_before) +
         picture(frame, cells, "New: how far values are off now, " + up_to(after),
                 "New errors, " + up_to(after), &shown_after) +
         picture(frame, cells, "Difference, old to new: " + changes,
                 "Difference between new and old: " + changes, &shown_change);
}

/// Pictures for a baseline without pixels: the new errors, and the certain part of the change.
std::string certain_pictures(const Frame& frame, const std::vector<CropCell>& cells,
                             const std::optional<records::Enclosure>& worst_before) {
  const auto after = largest(cells, [](const CropCell& c) { return c.error_after; });
  std::string text =
      "<p class=\"missing\">Old: the baseline kept no pixels of this triangle, so its picture "
      "cannot be shown.</p>\n" +
      picture(frame, cells, "New: how far values are off now, " + up_to(after),
              "New errors, " + up_to(after), &shown_after);
  if (!worst_before) return text;
  const double reach = records::magnitude_bound(*worst_before);
  const auto least = [reach](const CropCell& cell) {
    return cell.error_after ? std::optional(std::max(0.0, *cell.error_after - reach))
                            : std::nullopt;
  };
  const std::string most = up_to(largest(cells, least));
  return text + picture(frame, cells,
                        fmt::format("Difference, at least: no value of this case was more than {} "
                                    "ULP off, so pixels changed by at least this much: {}",
                                    size_text(reach), most),
                        "Least difference between new and old, " + most, [&](const CropCell& cell) {
                          const std::optional<double> size = least(cell);
                          if (!size) return shown_after(cell);
                          if (*size == 0) return ShownPixel{"same", "perhaps unchanged"};
                          return ShownPixel{step_class(*size), size_text(*size) + " ULP at least"};
                        });
}

// --- The pixels that changed most ----------------------------------------------------------------

std::string cell_value_text(const std::optional<float>& value) {
  if (!value) return "not drawn";
  return fmt::format("{:.9g}<br><code>{}</code>", *value, cases::to_hex(*value));
}

std::string cell_table(const std::vector<CropCell>& cells, bool has_before, bool has_samples) {
  std::vector<const CropCell*> listed;
  for (const CropCell& cell : cells) {
    if (has_before ? cell.change.value_or(0) > 0 : cell.error_after.value_or(0) > 0) {
      listed.push_back(&cell);
    }
  }
  const auto size = [has_before](const CropCell* cell) {
    return has_before ? *cell->change : *cell->error_after;
  };
  std::stable_sort(listed.begin(), listed.end(),
                   [&size](const CropCell* a, const CropCell* b) { return size(a) > size(b); });
  if (listed.size() > kMostListed) listed.resize(kMostListed);
  if (listed.empty()) return "";
  const auto number = [](const std::optional<double>& one) {
    return one ? size_text(*one) : std::string(kNothing);
  };
  std::string text = fmt::format(
      "<table class=\"pixels\">\n<thead><tr><th>{}</th><th>exact</th><th>old</th><th>new</th>"
      "<th class=\"number\">old error<br><small>scale ULP</small></th><th class=\"number\">new "
      "error<br><small>scale ULP</small></th></tr></thead>\n<tbody>\n",
      has_before ? "changed most" : "farthest off");
  for (const CropCell* one : listed) {
    text += "<tr>" +
            cell(has_samples ? fmt::format("({}, {}), sample {}", one->place.x, one->place.y,
                                           one->place.sample)
                             : fmt::format("({}, {})", one->place.x, one->place.y)) +
            named_cell("exact", one->exact ? fmt::format("{:.12g}", *one->exact) : "none") +
            named_cell("old", has_before ? cell_value_text(one->before) : "not kept") +
            named_cell("new", cell_value_text(one->after)) +
            number_cell("old error, ULP", number(one->error_before)) +
            number_cell("new error, ULP", number(one->error_after)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

}  // namespace

std::string compare_pictures(const records::CloserLook& look,
                             const std::optional<records::Enclosure>& worst_before) {
  const std::vector<CropCell> cells = crop_cells(look);
  const Frame frame(look.inspection);
  return "<div class=\"crops\">\n" +
         (look.before ? kept_pictures(frame, cells)
                      : certain_pictures(frame, cells, worst_before)) +
         "</div>\n" +
         cell_table(cells, look.before.has_value(), look.inspection.pattern.size() > 1);
}

std::string picture_legend() {
  return "<div class=\"key-of-crops\">\n" + legend_svg(ulp_scale()) +
         "<p><span class=\"swatch same\"></span> same bits, or perhaps unchanged <span "
         "class=\"swatch\"></span> not drawn <span class=\"swatch odd\">×</span> drawn in only "
         "one, NaN or infinite, or without an exact value <span class=\"swatch looked\"></span> "
         "the pixel in question. Point at a pixel to see its number. The triangle's exact outline "
         "is drawn on top. A pixel with several samples shows the one that changed most.</p>\n"
         "</div>\n";
}

std::string picture_style() {
  std::string text;
  for (int step = 0; step <= steps(); ++step) {
    const Color color = ramp_color(ulp_scale(), static_cast<double>(step) / steps());
    text += fmt::format(".c{}{{fill:#{:02x}{:02x}{:02x}}}", step, color[0], color[1], color[2]);
  }
  const Color odd = ulp_scale().violated;
  return text + fmt::format("\n:root{{--odd:#{:02x}{:02x}{:02x}}}\n", odd[0], odd[1], odd[2]);
}

}  // namespace rastercheck::reports

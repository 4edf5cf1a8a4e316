// svg: the figure of a case: pixels and their samples, the triangle, what is drawn and what must
// be.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/exporter.h"
#include "reports/finding_text.h"
#include "reports/internal/html.h"

namespace rastercheck::reports::svg_exporter {
namespace {

using records::InspectedSample;
using records::Verdict;

/// Width of a pixel in the figure.
constexpr double kPixel = 40;
/// Around the pixels, for their numbers.
constexpr double kMargin = 30;

/// How a sample is drawn, and the legend's words for it.
struct Look {
  const char* name;
  const char* style;
  const char* words;
};
// Shapes differ by more than colour: filled or hollow, thin or thick.
constexpr Look kRight{"r", "fill:#1a7f4b", "drawn, as it must be"};
constexpr Look kBlank{"b", "fill:none;stroke:#9a9a9a", "not drawn, correctly"};
constexpr Look kLeftOut{"l", "fill:none;stroke:#9a9a9a;stroke-dasharray:2 2",
                        "not drawn, as it may be"};
constexpr Look kMissing{"m", "fill:#fff;stroke:#c62828;stroke-width:3", "missing"};
constexpr Look kExtra{"x", "fill:#c62828;stroke:#c62828;stroke-width:3", "drawn, and must not be"};
constexpr Look kWrong{"w", "fill:#e08a00;stroke:#000;stroke-width:2", "drawn with a wrong value"};
constexpr Look kFree{"f", "fill:#9a9a9a", "drawn, as it may be"};
constexpr std::array kLooks{kRight, kBlank, kLeftOut, kMissing, kExtra, kWrong, kFree};

/// The violation at a sample; nullptr if none.
const records::Violation* violation_at(const records::Exhibit& exhibit,
                                       const cases::SamplePlace& place) {
  const auto& all = exhibit.violations;
  const auto found = std::find_if(all.begin(), all.end(), [&](const records::Violation& v) {
    return v.has_place() && v.place == place;
  });
  return found == all.end() ? nullptr : &*found;
}

/// A property may know more than the contract: of two triangles at a common edge, each may leave a
/// sample out, but not both.
const Look& look_of(const records::Exhibit& exhibit, const InspectedSample& sample) {
  if (const records::Violation* violation = violation_at(exhibit, sample.place)) {
    if (!sample.is_drawn) return kMissing;
    return violation->kind == records::AttributeKind::coverage ? kExtra : kWrong;
  }
  if (!sample.is_drawn) {
    if (sample.verdict == Verdict::required) return kMissing;
    return sample.verdict == Verdict::permitted ? kLeftOut : kBlank;
  }
  if (sample.verdict == Verdict::forbidden) return kExtra;
  return sample.verdict == Verdict::required ? kRight : kFree;
}

class Figure {
 public:
  Figure(const records::Exhibit& exhibit, const records::Inspection& part)
      : exhibit_(&exhibit), part_(&part) {}

  std::string draw() {
    const double width = kPixel * part_->width + 2 * kMargin;
    const double pixels_end = kPixel * part_->height + 2 * kMargin;
    body_ += fmt::format("<title>{}</title>\n", html(title()));
    grid();
    outline();
    for (const InspectedSample& sample : part_->samples) dot(sample);
    const double height = legend(pixels_end);
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
               "width=\"{0:g}\" height=\"{1:g}\" font-family=\"sans-serif\" font-size=\"11\">\n"
               "<style>{2}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
               std::max(width, 320.0), height, styles()) +
           body_ + "</svg>\n";
  }

 private:
  std::string title() const {
    if (exhibit_->violations.empty()) return exhibit_->backend + ": nothing is wrong here";
    return exhibit_->backend + ": " + finding_text(exhibit_->violations.front(), exhibit_->source);
  }

  static std::string styles() {
    std::string text = ".g{stroke:#ddd}.t{fill:#4a7ebb22;stroke:#2b5c9e;stroke-width:1.5}";
    for (const Look& look : kLooks) text += fmt::format(".{}{{{}}}", look.name, look.style);
    return text;
  }

  double x_of(double window_x) const { return kMargin + (window_x - part_->left) * kPixel; }
  double y_of(double window_y) const { return kMargin + (window_y - part_->top) * kPixel; }

  void line(double x1, double y1, double x2, double y2) {
    body_ += fmt::format("<line class=\"g\" x1=\"{:g}\" y1=\"{:g}\" x2=\"{:g}\" y2=\"{:g}\"/>\n",
                         x1, y1, x2, y2);
  }

  void grid() {
    const double right = part_->left + part_->width;
    const double bottom = part_->top + part_->height;
    for (std::uint32_t i = 0; i <= part_->width; ++i) {
      const double x = x_of(part_->left + i);
      line(x, y_of(part_->top), x, y_of(bottom));
      if (i == part_->width) break;
      body_ += fmt::format("<text x=\"{:g}\" y=\"{:g}\" text-anchor=\"middle\">{}</text>\n",
                           x + kPixel / 2, kMargin - 8, part_->left + i);
    }
    for (std::uint32_t i = 0; i <= part_->height; ++i) {
      const double y = y_of(part_->top + i);
      line(x_of(part_->left), y, x_of(right), y);
      if (i == part_->height) break;
      body_ += fmt::format("<text x=\"{:g}\" y=\"{:g}\" text-anchor=\"end\">{}</text>\n",
                           kMargin - 6, y + kPixel / 2 + 4, part_->top + i);
    }
  }

  /// The part of the outline that is near the pixels shown: browsers draw wrongly far outside.
  void outline() {
    if (part_->place.triangle >= part_->outlines.size()) return;
    const auto& points = part_->outlines[part_->place.triangle];
    if (points.empty()) return;
    body_ += fmt::format(
        "<clipPath id=\"c\"><rect x=\"{0:g}\" y=\"{0:g}\" width=\"{1:g}\" height=\"{2:g}\"/>"
        "</clipPath>\n<polygon class=\"t\" clip-path=\"url(#c)\" points=\"",
        kMargin, kPixel * part_->width, kPixel * part_->height);
    for (const records::WindowPoint& point : points) {
      body_ += fmt::format("{:.10g},{:.10g} ", x_of(point.x), y_of(point.y));
    }
    body_ += "\"/>\n";
  }

  void dot(const InspectedSample& sample) {
    if (sample.place.sample >= part_->pattern.size()) return;
    const records::WindowPoint& at = part_->pattern[sample.place.sample];
    const double radius = part_->pattern.size() == 1 ? 7 : 4;
    const Look& look = look_of(*exhibit_, sample);
    const double x = x_of(sample.place.x + at.x);
    const double y = y_of(sample.place.y + at.y);
    body_ += fmt::format("<circle class=\"{}\" cx=\"{:g}\" cy=\"{:g}\" r=\"{:g}\"/>\n", look.name,
                         x, y, radius);
    if (sample.place == part_->place) {
      body_ += fmt::format(
          "<circle fill=\"none\" stroke=\"#000\" cx=\"{:g}\" cy=\"{:g}\" r=\"{:g}\"/>\n", x, y,
          radius + 4);
    }
  }

  /// Explains the looks that occur; returns the figure's height.
  double legend(double y) {
    const auto row = [&](std::string_view class_name, std::string_view words) {
      body_ += fmt::format(
          "<circle class=\"{}\" cx=\"{:g}\" cy=\"{:g}\" r=\"5\"/>"
          "<text x=\"{:g}\" y=\"{:g}\">{}</text>\n",
          class_name, kMargin + 5, y, kMargin + 18, y + 4, words);
      y += 18;
    };
    for (const Look& look : kLooks) {
      const bool occurs = std::any_of(
          part_->samples.begin(), part_->samples.end(), [&](const InspectedSample& one) {
            return std::string_view(look_of(*exhibit_, one).name) == look.name;
          });
      if (occurs) row(look.name, look.words);
    }
    const std::size_t listed = exhibit_->violations.size();
    if (exhibit_->violation_count > listed) {
      body_ += fmt::format("<text x=\"{:g}\" y=\"{:g}\">Only {} of {} faults are marked.</text>\n",
                           kMargin, y + 4, listed, exhibit_->violation_count);
      y += 18;
    }
    return y + kMargin / 2;
  }

  const records::Exhibit* exhibit_;
  const records::Inspection* part_;
  std::string body_;
};

Result<std::string> write(const records::Exhibit& exhibit) {
  if (!exhibit.inspection) {
    return tl::unexpected(Error{exhibit.file, "", "has no sample to show"});
  }
  return Figure(exhibit, *exhibit.inspection).draw();
}

const ExporterRegistration kRegistration(
    {"svg", "a figure: pixels, samples, triangle, what is drawn, what must be", &write});

}  // namespace
}  // namespace rastercheck::reports::svg_exporter

#include "reports/gallery_page.h"

#include <fmt/format.h>

#include "cases/base64.h"
#include "records/enclosure.h"
#include "reports/internal/gallery_style.h"
#include "reports/internal/html.h"
#include "reports/internal/report_style.h"
#include "reports/internal/wording.h"
#include "reports/png.h"

namespace rastercheck::reports {
namespace {

constexpr std::string_view kTitle = "RasterCheck: the gallery";

constexpr std::string_view kLead =
    "Figures of five texts on interpolation in perspective, drawn "
    "anew with the methods that these texts are about. Beside every picture stands how far its "
    "values are from the exact perspective ones, which are computed in rational numbers.";

constexpr std::string_view kUnits =
    "Textures are 256 texels wide. Where an error is to be seen it is given in texels, or in "
    "levels "
    "of a colour; where all that is left are roundings, in scale ULP: 1 is the spacing of float32 "
    "numbers at the largest of a triangle's three values, so that a correctly rounded value is off "
    "by at most 0.5. The two have colours of their own. A pixel shows the largest error of its "
    "samples.";

/// Returns an image as the value of `src` or `url()`.
Result<std::string> data_of(const Image& image) {
  return to_png(image).map(
      [](const std::string& png) { return "data:image/png;base64," + cases::to_base64(png); });
}

struct PictureData {
  std::string picture;
  std::string errors;
};

Result<PictureData> data_of(const GalleryPicture& picture) {
  Result<std::string> drawn = data_of(picture.picture);
  if (!drawn) return tl::unexpected(drawn.error());
  Result<std::string> errors = data_of(picture.errors);
  if (!errors) return tl::unexpected(errors.error());
  return PictureData{*std::move(drawn), *std::move(errors)};
}

std::string definition(std::string_view term, const std::string& content) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", term, content);
}

std::string picture_facts(const GalleryPicture& picture) {
  const std::string_view unit = picture.scale->unit;
  std::string text =
      "<dl class=\"facts\">\n" +
      definition("drawn by", "<code>" + html(picture.method) + "</code>") +
      definition("worst error", gallery_error_text(picture.worst) + " " + std::string(unit)) +
      definition("99 in 100 errors", gallery_error_text(picture.p99) + " " + std::string(unit)) +
      definition("samples", grouped(picture.samples));
  if (picture.violations > 0) {
    text += definition(
        "not as promised",
        "<span class=\"violated\">" + counted(picture.violations, "sample", "samples") + "</span>");
  }
  return text + "</dl>\n";
}

/// Shows a picture beside a picture of its errors.
std::string pair_of(const GalleryPicture& picture, const PictureData& data) {
  const auto image = [&picture](const std::string& source, std::string_view what,
                                const std::string& more) {
    return fmt::format("<div><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}{}\">{}</div>\n",
                       source, picture.picture.width, picture.picture.height, html(picture.title),
                       what, more);
  };
  return "<div class=\"pair\">\n" + image(data.picture, "", "") +
         image(data.errors, ", its errors", "\n" + legend_svg(*picture.scale)) + "</div>\n" +
         picture_facts(picture);
}

/// Shows the frames of a strip, each as a part of the strip's image. The first pair is animated and
/// shows all frames in turn.
std::string strip_of(const GalleryPicture& picture, const PictureData& data) {
  const auto style = [](std::string_view of, double percent) {
    return fmt::format("style=\"background-image:var(--{});background-position:{:.3f}% 0\"", of,
                       percent);
  };
  const auto moving = [&](std::string_view of, std::string_view what, const std::string& more) {
    return fmt::format(
        "<div><div class=\"moving\" {} role=\"img\" aria-label=\"{}{}\"></div>{}"
        "</div>\n",
        style(of, 0), html(picture.title), what, more);
  };
  std::string text = fmt::format("<div style=\"--frames:{};--drawn:url({});--errors:url({})\">\n",
                                 picture.frames, data.picture, data.errors);
  text += "<div class=\"top\">\n<div class=\"pair\">\n" + moving("drawn", ", moving", "") +
          moving("errors", ", its errors, moving", "\n" + legend_svg(*picture.scale)) + "</div>\n" +
          picture_facts(picture) + "</div>\n";
  for (const std::string_view of : {"drawn", "errors"}) {
    text += "<div class=\"frames\">";
    for (int i = 0; i < picture.frames; ++i) {
      text += fmt::format("<div {}></div>", style(of, 100.0 * i / (picture.frames - 1)));
    }
    text += "</div>\n";
  }
  return text + "</div>\n";
}

Result<std::string> panel_of(const GalleryPicture& picture) {
  const std::string caption =
      "<figcaption><strong>" + html(picture.title) + "</strong></figcaption>\n";
  if (!picture.missing.empty()) {
    return "<figure class=\"panel\">\n" + caption + "<p class=\"absent\">" + html(picture.missing) +
           ".</p>\n</figure>\n";
  }
  const Result<PictureData> data = data_of(picture);
  if (!data) return tl::unexpected(data.error());
  const bool is_strip = picture.frames > 1;
  return fmt::format("<figure class=\"panel{}\">\n{}{}</figure>\n", is_strip ? " wide" : "",
                     caption, is_strip ? strip_of(picture, *data) : pair_of(picture, *data));
}

Result<std::string> figure_section(const GalleryFigure& figure, std::size_t number) {
  std::string text = fmt::format(
      "<section class=\"drawn\" id=\"figure-{}\">\n<h2>{}</h2>\n<p class=\"source\">{}</p>\n",
      number, html(figure.title), html(figure.source));
  for (const std::string& sentence : figure.sentences) text += "<p>" + html(sentence) + "</p>\n";
  if (!figure.plots.empty()) {
    text += "<div class=\"plots\">\n";
    for (const GalleryPlot& plot : figure.plots) {
      text += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                          line_plot_svg(plot.plot), html(plot.caption));
    }
    text += "</div>\n";
  }
  if (!figure.pictures.empty()) {
    text += "<div class=\"panels\">\n";
    for (const GalleryPicture& picture : figure.pictures) {
      const Result<std::string> panel = panel_of(picture);
      if (!panel) return tl::unexpected(panel.error());
      text += *panel;
    }
    text += "</div>\n";
  }
  return text + "</section>\n";
}

std::string contents_of(std::span<const GalleryFigure> figures) {
  std::string text = "<nav><ul>\n";
  for (std::size_t i = 0; i < figures.size(); ++i) {
    text += fmt::format("<li><a href=\"#figure-{}\">{}</a></li>\n", i, html(figures[i].title));
  }
  return text + "</ul></nav>\n";
}

}  // namespace

std::string gallery_error_text(double error) {
  return at_most_text(records::Enclosure{error, error});
}

Result<std::string> gallery_html(std::span<const GalleryFigure> figures) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n<main>\n"
      "<header>\n<p class=\"name\">RasterCheck</p>\n<h1>Interpolation in perspective, in pictures"
      "</h1>\n<p class=\"lead\">{}</p>\n</header>\n",
      kTitle, kReportStyle, kGalleryStyle, kLead);
  text += contents_of(figures) + fmt::format("<p class=\"unit\">{}</p>\n", kUnits);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const Result<std::string> section = figure_section(figures[i], i);
    if (!section) return tl::unexpected(section.error());
    text += *section;
  }
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace rastercheck::reports

#include "reports/judged_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "cases/names.h"
#include "records/share.h"
#include "reports/commands.h"
#include "reports/internal/contract_facts.h"
#include "reports/internal/html.h"
#include "reports/internal/judged_pictures.h"
#include "reports/internal/judged_style.h"
#include "reports/internal/page.h"
#include "reports/internal/part_data.h"
#include "reports/internal/picture_colors.h"
#include "reports/internal/picture_wording.h"
#include "reports/internal/report_style.h"
#include "reports/internal/viewer.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::JudgedPicture;
using records::PicturePart;
using records::PixelVerdict;
using records::WrongPixel;

/// The largest size of the parts' data in the page, in bytes.
constexpr std::size_t kMostPartData = 1'000'000;

struct Headline {
  std::string text;
  std::string_view style;
};

Headline headline_of(const JudgedPicture& judged) {
  const std::uint64_t all = pixel_count(judged);
  const std::uint64_t open = judged.count(PixelVerdict::not_judged);
  if (judged.wrong() > 0) {
    return {
        fmt::format("Wrong: {} of {}", grouped(judged.wrong()), counted(all, "pixel", "pixels")),
        "violated"};
  }
  if (open == 0) return {fmt::format("Right: all {}", counted(all, "pixel", "pixels")), "held"};
  if (judged.count(PixelVerdict::right) == 0) return {"Nothing could be judged", "mixed"};
  return {fmt::format("Not judged: {} of {}; the others are right", grouped(open),
                      counted(all, "pixel", "pixels")),
          "mixed"};
}

std::string file_name(const std::string& file) { return file == "-" ? "standard input" : file; }

std::string pixel_name(int x, int row) { return fmt::format("pixel ({}, {})", x, row); }

/// Names the permitted answer that is closest to the pixel: "triangle 3".
std::string compared_with(const WrongPixel& pixel, const JudgedPage& page) {
  if (pixel.triangle) return fmt::format("triangle {}", *pixel.triangle);
  return page.view.size.samples > 1 ? "the mean of its samples" : "the background";
}

/// Says what is wrong with a pixel, without its name; HTML.
std::string fault_sentence(const WrongPixel& pixel, const JudgedPage& page) {
  std::string text =
      fmt::format("{}: {}", to_string(pixel.verdict), html(fault_of(pixel, page.view)));
  const std::string steps = steps_text(pixel.steps);
  if (!steps.empty()) text += fmt::format("; <strong>{}</strong>", steps);
  return text + ", compared with " + compared_with(pixel, page);
}

/// Returns the part's chosen pixel, compared with the closest of its permitted answers.
WrongPixel wrong_pixel_of(const PicturePart& part) {
  const records::DetailedPixel& pixel = part.at(part.x, part.row);
  WrongPixel wrong{part.x, part.row, pixel.verdict, {}, {}, 0};
  if (pixel.answers.empty()) return wrong;
  const records::PermittedAnswer& answer = pixel.answers.front();
  wrong.triangle = answer.triangle;
  wrong.steps = answer.steps;
  for (std::size_t c = 0; c < answer.channels.size(); ++c) {
    const records::StoredRange& range = answer.channels[c];
    wrong.channels.push_back({pixel.stored[c], range.least, range.greatest, range.is_free});
  }
  return wrong;
}

std::string kinds_table(const JudgedPicture& judged) {
  std::string text =
      "<table class=\"kinds\">\n<thead><tr><th>verdict</th><th class=\"number\">pixels</th>"
      "<th class=\"number\">share</th><th>meaning</th></tr></thead>\n<tbody>\n";
  // Wrong pixels come first, then those not judged, and right ones last.
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i < records::kPixelVerdicts; ++i) order.push_back(i);
  order.push_back(0);
  for (const std::size_t i : order) {
    if (judged.counts[i] == 0) continue;
    const auto verdict = static_cast<PixelVerdict>(i);
    const Color color = color_of(verdict);
    text += "<tr>" +
            cell(fmt::format("<span class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\" "
                             "aria-hidden=\"true\"></span>{}",
                             color[0], color[1], color[2], to_string(verdict))) +
            number_cell("pixels", grouped(judged.counts[i])) +
            number_cell("share", records::share_text(judged.counts[i], pixel_count(judged))) +
            cell(html(meaning_of(verdict))) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

/// Returns the `explain` command for a pixel of the file, whose row it converts to window y.
std::string explain_text(const JudgedPage& page, const WrongPixel& pixel) {
  std::vector<std::string> words = page.explain;
  words.insert(words.end(),
               {"--pixel", fmt::format("{},{}", pixel.x, page.view.flipped(pixel.row))});
  if (pixel.triangle) words.insert(words.end(), {"--triangle", std::to_string(*pixel.triangle)});
  return command_line(words);
}

std::string next_step(std::string_view what, const std::string& command) {
  return fmt::format("<div><dt>{}</dt><dd><code>{}</code></dd></div>\n", what, html(command));
}

std::string next_steps(const JudgedPage& page) {
  std::string text = "<dl class=\"next\">\n";
  if (!page.judged.worst.empty() && !page.explain.empty()) {
    text += next_step("explain what must be drawn at the pixel farthest off",
                      explain_text(page, page.judged.worst.front()));
  }
  return text + next_step("judge it again", command_line(page.command)) + "</dl>\n";
}

/// Which pixels were not judged, and what was judged less strictly, with the reasons.
std::string judged_gaps(const JudgedPicture& judged) {
  const std::uint64_t open = judged.count(PixelVerdict::not_judged);
  std::string text;
  if (open == 0) {
    text += "<li>Every pixel was judged.</li>\n";
  } else if (judged.unpromised_triangles > 0) {
    text += fmt::format(
        "<li>{} not judged. Nothing is promised about {}, which may be seen anywhere; another "
        "contract may promise something: <code>--contract FILE</code>.</li>\n",
        counted(open, "pixel was", "pixels were"),
        counted(judged.unpromised_triangles, "triangle", "triangles"));
  } else {
    text += fmt::format("<li>{} not judged.</li>\n", counted(open, "pixel was", "pixels were"));
  }
  for (const std::string& sentence : freedom_sentences(judged)) {
    text += "<li>" + html(sentence) + "</li>\n";
  }
  return "<h2>What was judged</h2>\n<ul class=\"gaps\">\n" + text + "</ul>\n";
}

std::string storage_text(const JudgedPage& page) {
  std::string text;
  for (const cases::ShownChannel& channel : page.view.channels) {
    const std::string_view name = cases::name_of(channel.storage);
    if (text.find(name) == std::string::npos) {
      text += (text.empty() ? "" : ", ") + std::string(name);
    }
  }
  text += page.view.rounding == cases::StoreRounding::nearest ? ", rounded to nearest"
                                                              : ", either neighbour";
  if (page.view.size.samples > 1) {
    text += page.view.resolve == cases::ResolveOf::linear ? "; means of numbers"
                                                          : "; means of stored values";
  }
  return text;
}

std::string contract_aside(const JudgedPage& page) {
  std::string text =
      "<aside>\n<h2>Judged by</h2>\n<p>" + html(page.judged_by) + "</p>\n<dl class=\"facts\">\n";
  for (const auto& [term, words] : contract_facts(page.contract, page.source)) {
    text += definition(term, html(words));
  }
  return text + definition("stored numbers", html(storage_text(page))) + "</dl>\n</aside>\n";
}

std::string shown_channels_text(const JudgedPage& page) {
  constexpr std::size_t kMostNamed = 8;
  const std::size_t count = page.view.channels.size();
  std::string text;
  for (std::size_t c = 0; c < std::min(count, kMostNamed); ++c) {
    text += fmt::format("{}{} shows {}", c == 0 ? "" : ", ", page.view.channels[c].name,
                        shown_text(page, c));
  }
  if (count > kMostNamed) text += fmt::format(", and {} more", count - kMostNamed);
  return text;
}

std::string judged_front(const JudgedPage& page) {
  const JudgedPicture& judged = page.judged;
  const Headline headline = headline_of(judged);
  std::string text = fmt::format(
      "<header>\n<p class=\"name\">RasterCheck: a judged picture</p>\n<h1 class=\"{}\">{}</h1>\n"
      "<p class=\"judged\"><b>{}</b>, {} × {} pixels · case <b>{}</b>{} · {}</p>\n</header>\n",
      headline.style, headline.text, html(file_name(page.picture_file)), judged.width,
      judged.height, html(file_name(page.case_file)),
      page.source.name.empty() ? "" : fmt::format(", “{}”", html(page.source.name)),
      html(shown_channels_text(page)));
  text += "<div class=\"front\">\n<section>\n";
  if (!judged.worst.empty()) {
    const WrongPixel& worst = judged.worst.front();
    text += fmt::format("<p class=\"finding\">Farthest off is <b>{}</b>, {}.</p>\n",
                        pixel_name(worst.x, worst.row), fault_sentence(worst, page));
  }
  return text + kinds_table(judged) + next_steps(page) + judged_gaps(judged) + "</section>\n" +
         contract_aside(page) + "</div>\n";
}

/// Lists the pixels that are farthest off, for readers without scripts too.
std::string worst_pixels(const JudgedPage& page) {
  if (page.judged.worst.empty()) return "";
  std::string text = fmt::format(
      "<details class=\"worst\"><summary>The {} farthest off, as a table</summary>\n"
      "<table class=\"sortable\">\n<thead><tr><th class=\"number\">x</th>"
      "<th class=\"number\">row</th><th>verdict</th><th class=\"number\">steps off</th>"
      "<th>fault</th><th>compared with</th></tr></thead>\n<tbody>\n",
      counted(page.judged.worst.size(), "pixel", "pixels"));
  for (const WrongPixel& pixel : page.judged.worst) {
    text += "<tr>" + number_cell("x", std::to_string(pixel.x)) +
            number_cell("row", std::to_string(pixel.row)) +
            cell(std::string(to_string(pixel.verdict))) +
            number_cell("steps off", std::isfinite(pixel.steps) ? fmt::format("{:.6g}", pixel.steps)
                                                                : std::string(kNothing)) +
            cell(html(fault_of(pixel, page.view))) + cell(compared_with(pixel, page)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n</details>\n";
}

std::string part_section(const JudgedPage& page, std::size_t index, const std::string& data) {
  const PicturePart& part = page.parts[index];
  const PixelVerdict verdict = part.at(part.x, part.row).verdict;
  const bool is_whole = part.width == page.judged.width && part.height == page.judged.height;
  const bool is_right = verdict == PixelVerdict::right;
  std::string title = is_right || verdict == PixelVerdict::not_judged
                          ? std::string(to_string(verdict))
                          : fault_sentence(wrong_pixel_of(part), page);
  const std::string range =
      is_whole ? std::string("the whole picture")
               : fmt::format("columns {} to {}, rows {} to {}", part.left,
                             part.left + part.width - 1, part.top, part.top + part.height - 1);
  return fmt::format(
      "<details class=\"finding\" id=\"{0}\" data-inspection=\"{1}\" data-kind=\"part\"{2}>\n"
      "<summary><span class=\"{3}\">{4}</span> <span class=\"title\">Pixel ({5}, {6})</span>, {7} "
      "<small>{8}</small></summary>\n<div class=\"viewer-place\"></div>\n"
      "<script type=\"application/json\">{9}</script>\n</details>\n",
      inspection_link(index), index, index == 0 ? " open" : "",
      is_right                              ? "held"
      : verdict == PixelVerdict::not_judged ? "unchecked"
                                            : "violated",
      is_right                              ? "✓"
      : verdict == PixelVerdict::not_judged ? "◦"
                                            : "✗",
      part.x, part.row, title, range, data);
}

/// The number of wrong pixels that lie in one of the first `shown` parts.
std::uint64_t wrong_pixels_in(const JudgedPage& page, std::size_t shown) {
  std::vector<bool> is_shown(page.judged.pixels.size());
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < shown; ++i) {
    const PicturePart& part = page.parts[i];
    for (int row = part.top; row < part.top + part.height; ++row) {
      for (int x = part.left; x < part.left + part.width; ++x) {
        const std::size_t place =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(page.judged.width) +
            static_cast<std::size_t>(x);
        const PixelVerdict verdict = page.judged.pixels[place];
        if (is_shown[place]) continue;
        is_shown[place] = true;
        wrong += verdict != PixelVerdict::right && verdict != PixelVerdict::not_judged ? 1 : 0;
      }
    }
  }
  return wrong;
}

std::string parts_section(const JudgedPage& page, const PictureColors& colors) {
  if (page.parts.empty()) return "";
  std::string sections;
  std::size_t shown = 0;
  std::size_t bytes = 0;
  for (; shown < page.parts.size(); ++shown) {
    const std::string data = part_data(page, colors, page.parts[shown]);
    bytes += data.size();
    if (shown > 0 && bytes > kMostPartData) break;
    sections += part_section(page, shown, data);
  }
  const std::uint64_t wrong = wrong_pixels_in(page, shown);
  const std::uint64_t left_out = page.judged.wrong() - wrong;
  std::string extent;
  if (left_out > 0) {
    extent = fmt::format(
        "{} with {} of {} wrong pixels: of each kind those farthest off, and a sample of the rest. "
        "The other {} are in the pictures above only.",
        counted(shown, "part", "parts"), grouped(wrong), grouped(page.judged.wrong()),
        grouped(left_out));
  }
  return fmt::format(
             "<section id=\"pixels\">\n<h2>Pixel by pixel</h2>\n<p class=\"unit\">{} A step is "
             "from "
             "one value that can be stored to the next: 1/255 or 1/65535 of integers, one ULP of "
             "floats. Pixels are named (x, row of the file).</p>\n",
             extent) +
         sections + worst_pixels(page) + "</section>\n";
}

}  // namespace

bool is_upwards(const JudgedPage& page) {
  // OpenGL's window y points up.
  return (page.source.rules == cases::Rules::opengl) != page.view.is_flipped;
}

std::string shown_text(const JudgedPage& page, std::size_t channel) {
  const cases::ShownChannel& shown = page.view.channels[channel];
  switch (shown.shows) {
    case cases::Shown::attribute: {
      const std::string& name = page.source.attributes[shown.attribute].name;
      return name.empty() ? fmt::format("attribute {}", shown.attribute) : name;
    }
    case cases::Shown::depth:
      return "depth";
    case cases::Shown::triangle:
      return "the triangle's index plus 1";
    case cases::Shown::coverage:
      return "coverage";
    case cases::Shown::constant:
      return fmt::format("the number {}", shown.constant);
    case cases::Shown::nothing:
      break;
  }
  return "what is not judged";
}

Result<std::string> judged_html(const JudgedPage& page) {
  const PictureColors colors(page.picture);
  const Result<std::string> pictures = pictures_section(page, colors);
  if (!pictures) return tl::unexpected(pictures.error());
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{}: {} – RasterCheck</title>\n<style>\n{}{}{}</style>\n</head>\n<body>\n<main>\n",
      viewer_policy(), html(file_name(page.picture_file)), headline_of(page.judged).text,
      kReportStyle, kViewerStyle, kJudgedStyle);
  text += judged_front(page) + *pictures + parts_section(page, colors) + "</main>\n";
  return text + viewer_scripts() + "</body>\n</html>\n";
}

}  // namespace rastercheck::reports

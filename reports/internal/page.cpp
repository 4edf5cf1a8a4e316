#include "reports/internal/page.h"

#include <fmt/format.h>

#include "reports/internal/html.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::LawSummary;
using records::LawVerdict;

std::string cell_html(std::string_view style, std::string_view name, const std::string& content) {
  const std::string_view none = content == kNothing ? " none" : "";
  return fmt::format("<td class=\"{}{}\" data-name=\"{}\">{}</td>", style, none, name, content);
}

/// Encodes a text as application/x-www-form-urlencoded, the syntax of the viewer's links.
std::string url_encoded(std::string_view text) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789*-._";
  std::string encoded;
  for (const char c : text) {
    if (c == ' ') {
      encoded += '+';
    } else if (kPlain.find(c) != std::string_view::npos) {
      encoded += c;
    } else {
      encoded += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return encoded;
}

}  // namespace

std::string named_cell(std::string_view name, const std::string& content) {
  return cell_html("named", name, content);
}
std::string number_cell(std::string_view name, const std::string& content) {
  return cell_html("number", name, content);
}

std::string definition(std::string_view term, const std::string& content) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", term, content);
}

std::string counted_spans(const std::map<std::string, std::uint64_t>& all) {
  std::string text;
  for (const auto& [name, cases] : all) {
    text += fmt::format("<span>{} {}</span> ", html(name), grouped(cases));
  }
  return text;
}

std::string_view verdict_class(LawVerdict verdict) {
  switch (verdict) {
    case LawVerdict::held:
      return "held";
    case LawVerdict::violated:
      return "violated";
    case LawVerdict::known:
    case LawVerdict::thin:
    case LawVerdict::not_checked:
      break;
  }
  return "unchecked";
}

std::string_view verdict_sign(LawVerdict verdict) {
  switch (verdict) {
    case LawVerdict::held:
      return "✓";
    case LawVerdict::violated:
      return "✗";
    case LawVerdict::known:
      return "≈";
    case LawVerdict::thin:
      return "(✓)";
    case LawVerdict::not_checked:
      break;
  }
  return kNothing;
}

std::string verdict_word(const LawSummary& row) {
  return fmt::format(R"(<span class="{}">{} {}</span>)", verdict_class(row.verdict),
                     verdict_sign(row.verdict), html(verdict_text(row)));
}

std::string law_link(std::string_view law) { return "property=" + url_encoded(law); }
std::string inspection_link(std::size_t inspection) {
  return fmt::format("inspection={}", inspection);
}

}  // namespace rastercheck::reports

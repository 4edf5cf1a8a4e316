// compare.html: the findings of a comparison as a single self-contained page, without scripts.

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "reports/compare_format.h"
#include "reports/internal/compare_entries.h"
#include "reports/internal/compare_front.h"
#include "reports/internal/compare_growths.h"
#include "reports/internal/compare_pictures.h"
#include "reports/internal/compare_style.h"
#include "reports/internal/html.h"
#include "reports/internal/report_style.h"
#include "reports/internal/viewer.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports::compare_html_format {
namespace {

/// The content security policy: a browser may load and run nothing.
constexpr std::string_view kPolicy =
    "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

std::string write(const Gate& gate) {
  const std::string headline = compare_headline(gate);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n"
      "<html lang=\"en\">\n"
      "<head>\n"
      "<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>RasterCheck: {}</title>\n"
      "<style>\n"
      "{}{}{}{}</style>\n"
      "</head>\n"
      "<body>\n"
      "<main>\n"
      "<header>\n"
      "<p class=\"name\">RasterCheck: comparison with the baseline</p>\n"
      "<h1 class=\"{}\">{}</h1>\n"
      "</header>\n",
      kPolicy, html(headline), kReportStyle, kViewerStyle, kCompareStyle, picture_style(),
      refused(gate.comparisons) > 0 ? "violated" : "held", html(headline));
  for (std::size_t i = 0; i < gate.comparisons.size(); ++i) {
    const records::Comparison& comparison = gate.comparisons[i];
    text += compare_front(gate, i) + growth_sections(gate, i) + entry_sections(comparison, i) +
            other_entries(comparison);
  }
  return text + policy_section(gate.policy) +
         fmt::format("<p class=\"unit\">{}</p>\n", html(kUnitSentence)) +
         "</main>\n</body>\n</html>\n";
}

const CompareFormatRegistration kRegistration({"html", "compare.html", &write});

}  // namespace
}  // namespace rastercheck::reports::compare_html_format

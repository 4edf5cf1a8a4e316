#include "reports/internal/report_power.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "records/share.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

std::string noticed_text(const records::Power& power, records::Defect defect) {
  const auto found = power.find(defect);
  if (found == power.end()) return std::string(kNothing);
  const auto& [drawings, noticed] = found->second;
  const std::string share =
      drawings < records::kEnoughDrawings ? "too few" : records::share_text(noticed, drawings);
  return fmt::format("{} <small>{} of {}</small>", share, grouped(noticed), grouped(drawings));
}

/// "435 drawings of gl:softpipe made wrong on purpose, 400 noticed", for each backend.
std::string power_words(const std::map<std::string, records::Power>& backends) {
  std::string text;
  for (const auto& [backend, power] : backends) {
    const records::Noticed sum = records::total(power);
    text +=
        fmt::format("{}{} of {} made wrong on purpose, {} noticed", text.empty() ? "" : "; ",
                    counted(sum.drawings, "drawing", "drawings"), backend, grouped(sum.noticed));
  }
  return text;
}

}  // namespace

std::string power_of(const std::vector<records::LawSummary>& rows) {
  const auto backends = records::power_by_backend(rows);
  if (backends.empty()) return "";
  std::set<records::Defect> defects;
  std::string text = fmt::format(
      "<section id=\"power\">\n<h2>What this run would have noticed</h2>\n"
      "<p class=\"unit\">Some right drawings were made wrong on purpose and judged again under the "
      "same contract. A share of fewer than {} drawings says little; <code>--power</code> with a "
      "smaller number makes more.</p>\n"
      "<details>\n<summary>{}</summary>\n<table class=\"power "
      "sortable\">\n<thead><tr><th>defect</th>",
      records::kEnoughDrawings, html(power_words(backends)));
  for (const auto& [backend, power] : backends) {
    text += fmt::format("<th class=\"number\">{}</th>", html(backend));
    for (const auto& [defect, noticed] : power) defects.insert(defect);
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const records::Defect defect : defects) {
    text += "<tr>" + cell(html(to_string(defect)));
    for (const auto& [backend, power] : backends) {
      text += number_cell(html(backend), noticed_text(power, defect));
    }
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table>\n</details>\n</section>\n";
}

}  // namespace rastercheck::reports

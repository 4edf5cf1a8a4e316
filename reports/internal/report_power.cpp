#include "reports/internal/report_power.h"

#include <fmt/format.h>

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

}  // namespace

std::string power_of(const std::vector<records::LawSummary>& rows) {
  const auto backends = records::power_by_backend(rows);
  if (backends.empty()) return "";
  std::set<records::Defect> defects;
  std::string text = fmt::format(
      "<section id=\"power\">\n<h2>What this run would have noticed</h2>\n"
      "<p class=\"unit\">Some drawings that were right were made wrong on purpose, and judged "
      "again by the same contract: of so many each defect was noticed. Below {} drawings the share "
      "says little; <code>--power</code> with a smaller number makes more.</p>\n"
      "<table class=\"power sortable\">\n<thead><tr><th>defect</th>",
      records::kEnoughDrawings);
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
  return text + "</tbody>\n</table>\n</section>\n";
}

}  // namespace rastercheck::reports

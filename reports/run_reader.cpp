#include "reports/run_reader.h"

#include "cases/files.h"
#include "cases/json_members.h"
#include "reports/internal/run_members.h"

namespace rastercheck::reports {

Result<records::Run> parse_run(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &cases::read_as<records::Run>);
}

Result<records::Run> read_run(const std::string& file) {
  return cases::read_text(file).and_then(
      [&file](const std::string& text) { return parse_run(text, file); });
}

}  // namespace rastercheck::reports

#include "reports/run_reader.h"

#include <array>

#include "cases/files.h"
#include "cases/json_members.h"
#include "reports/internal/run_members.h"

namespace rastercheck::reports {

namespace {

Result<records::Run> read_file(const std::string& file, cases::JsonNode::Keys left_out) {
  return cases::read_text(file).and_then([&](const std::string& text) {
    return cases::read_json(text, file, &cases::read_as<records::Run>, left_out);
  });
}

}  // namespace

Result<records::Run> parse_run(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &cases::read_as<records::Run>);
}

Result<records::Run> read_run(const std::string& file) { return read_file(file, {}); }

Result<records::Run> read_run_without_inspections(const std::string& file) {
  constexpr auto kLeftOut = std::to_array<std::string_view>({"inspections"});
  return read_file(file, kLeftOut);
}

}  // namespace rastercheck::reports

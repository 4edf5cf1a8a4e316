#include "backends/drawn/folder.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "backends/drawn/draw_file.h"
#include "backends/drawn/drawn_file.h"
#include "backends/drawn/fragment_picture.h"
#include "cases/case_writer.h"
#include "cases/digest.h"
#include "cases/files.h"
#include "cases/fragments_json.h"
#include "cases/json.h"
#include "cases/json_members.h"
#include "cases/picture_reader.h"
#include "records/plan_json.h"

namespace rastercheck::backends {

template <typename Archive, cases::Either<DrawnCampaign> T>
void members(Archive& archive, T& campaign) {
  archive.format("rastercheck-campaign", 1);
  archive.required("program", campaign.program);
  archive.required("plan", campaign.plan);
  archive.check([&](const cases::JsonNode& node) {
    if (campaign.plan.backends.size() != 1) node["plan"].refuse("must have one backend");
  });
}

namespace {

std::string path_of(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

/// The endings of the file names of drawings.
constexpr std::array<std::string_view, 4> kEndings{".drawn", ".json", ".npy", ".exr"};

/// Returns all files that claim to be the drawing of a case; more than one is an error.
std::vector<std::string> drawings_of(const std::string& folder, const std::string& name) {
  std::vector<std::string> found;
  for (const std::string_view ending : kEndings) {
    const std::string file = path_of(folder, fmt::format("drawn/{}{}", name, ending));
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) found.push_back(file);
  }
  return found;
}

Result<std::vector<std::string>> read_list(const std::string& folder) {
  return cases::read_text(path_of(folder, "list.txt")).map([](const std::string& text) {
    std::vector<std::string> names;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) names.push_back(line);
    return names;
  });
}

}  // namespace

std::string drawn_name(const cases::Case& c) {
  cases::Case drawn = c;
  drawn.name.clear();
  drawn.essential.reset();
  drawn.choices.reset();
  drawn.found.reset();
  drawn.picture.reset();
  return fmt::format("{:016x}", cases::fnv1a(cases::to_json(drawn)));
}

Result<DrawnCampaign> read_drawn_campaign(const std::string& folder) {
  const std::string file = path_of(folder, "campaign.json");
  return cases::read_text(file).and_then([&](const std::string& text) {
    return cases::read_json(text, file, &cases::read_as<DrawnCampaign>);
  });
}

Result<DrawnCount> count_drawn(const std::string& folder) {
  return read_list(folder).map([&](const std::vector<std::string>& names) {
    DrawnCount count{names.size(), 0};
    for (const std::string& name : names) {
      if (!drawings_of(folder, name).empty()) ++count.drawn;
    }
    return count;
  });
}

Result<cases::Fragments> read_drawing(const std::string& folder, const cases::Case& c) {
  const std::string name = drawn_name(c);
  const std::vector<std::string> files = drawings_of(folder, name);
  if (files.empty()) {
    return tl::unexpected(
        Error{"", "", "the folder has no drawing of the case: " + name, Failure::unsupported});
  }
  if (files.size() > 1) {
    return tl::unexpected(
        Error{files[0], "", fmt::format("{} is a drawing of the same case", files[1])});
  }
  const std::string& file = files.front();
  const Result<std::string> bytes = cases::read_text(file);
  if (!bytes) return tl::unexpected(bytes.error());
  if (file.ends_with(".drawn")) return parse_drawn(*bytes, file, c);
  if (file.ends_with(".json")) return cases::parse_fragments(*bytes, file, c);
  return cases::parse_picture(*bytes, file, cases::ArrayOrder::hwc)
      .and_then([&](const cases::PictureFile& picture) {
        return fragments_of_picture(picture, file, c);
      });
}

About drawn_about(About promiser) {
  promiser.driver.reset();
  promiser.same_as.clear();
  promiser.ways.clear();
  promiser.answers_occlusion_queries = false;
  promiser.draws_pictures = false;
  promiser.has_limits = true;
  return promiser;
}

Result<CaseFolder> CaseFolder::make(const std::string& folder) {
  std::error_code why;
  if (std::filesystem::exists(folder, why) && !std::filesystem::is_empty(folder, why)) {
    return tl::unexpected(Error{folder, "", "is not an empty folder"});
  }
  for (const char* inner : {"cases", "drawn"}) {
    std::filesystem::create_directories(std::filesystem::path(folder) / inner, why);
    if (why) return tl::unexpected(Error{folder, "", "cannot be created: " + why.message()});
  }
  return CaseFolder(folder);
}

Result<void> CaseFolder::add(const cases::Case& c, const cases::Contract& promised) {
  const std::string name = drawn_name(c);
  if (!known_.insert(name).second) return {};
  names_.push_back(name);
  const std::string file = path_of(folder_, "cases/" + name);
  return cases::write_file(file + ".json", cases::to_json(c)).and_then([&] {
    return cases::write_file(file + ".draw", draw_file(c, promised));
  });
}

Result<void> CaseFolder::finish(const DrawnCampaign& campaign) const {
  std::string list;
  for (const std::string& name : names_) list += name + "\n";
  return cases::write_file(path_of(folder_, "list.txt"), list).and_then([&] {
    return cases::write_file(path_of(folder_, "campaign.json"),
                             cases::json_line(cases::json_of(campaign)) + "\n");
  });
}

}  // namespace rastercheck::backends

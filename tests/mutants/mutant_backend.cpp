#include "tests/mutants/mutant_backend.h"

#include <dlfcn.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

#include "backends/backend.h"

namespace rastercheck::mutants {
namespace {

Error cannot_load(const std::string& name) {
  const char* reason = dlerror();
  return {"mutant:" + name, "", reason == nullptr ? "its module cannot be loaded" : reason};
}

Result<std::unique_ptr<backends::Backend>> make(const std::string& name) {
  const std::vector<std::string>& names = mutant_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    return tl::unexpected(Error{"mutant:" + name, "", "no mutant of that name"});
  }
  const std::string path = RASTERCHECK_MUTANT_MODULES "/" + name + ".so";
  // RTLD_LOCAL: two mutants at once must not see each other's symbols. Never closed: the backend's
  // code is the module's.
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return tl::unexpected(cannot_load(name));
  void* const symbol = dlsym(library, "rastercheck_make_mutant");
  if (symbol == nullptr) return tl::unexpected(cannot_load(name));
  const std::string of = header_of(name).of;
  const auto make_mutant = reinterpret_cast<backends::Backend* (*)(const char*)>(symbol);
  std::unique_ptr<backends::Backend> backend(make_mutant(of.c_str()));
  if (backend == nullptr) {
    return tl::unexpected(Error{"mutant:" + name, "", "its 'Of: " + of + "' is no backend"});
  }
  return backend;
}

std::vector<backends::Listing> list() {
  std::vector<backends::Listing> all;
  for (const std::string& name : mutant_names()) {
    const std::string specification = "mutant:" + name;
    const auto made = make(name);
    all.push_back({specification, "the rasterizer with a defect",
                   made ? std::string() : to_string(made.error())});
  }
  return all;
}

const backends::BackendRegistration kRegistration({"mutant", &make, &list});

}  // namespace

const std::vector<std::string>& mutant_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    std::istringstream list(RASTERCHECK_MUTANT_NAMES);
    for (std::string name; std::getline(list, name, ',');) all.push_back(name);
    return all;
  }();
  return names;
}

Header header_of(const std::string& mutant) {
  Header header;
  const std::pair<std::string_view, std::string*> fields[] = {
      {"Defect: ", &header.defect},
      {"Killed by: ", &header.killed_by},
      {"Equivalent: ", &header.equivalent},
      {"Of: ", &header.of},
      {"Attributed to: ", &header.attributed_to},
      {"Least: ", &header.least}};
  std::ifstream patch(RASTERCHECK_MUTANT_PATCHES "/" + mutant + ".patch");
  for (std::string line; std::getline(patch, line) && !line.starts_with("--- ");) {
    for (const auto& [name, value] : fields) {
      if (line.starts_with(name)) *value = line.substr(name.size());
    }
  }
  return header;
}

}  // namespace rastercheck::mutants

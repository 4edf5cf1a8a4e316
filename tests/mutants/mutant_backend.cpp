#include "tests/mutants/mutant_backend.h"

#include <dlfcn.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

#include "backends/backend.h"
#include "backends/factory.h"
#include "tests/mutants/overlaid_backend.h"

namespace rastercheck::mutants {
namespace {

Error cannot_load(const std::string& name) {
  const char* reason = dlerror();
  return {"mutant:" + name, "", reason == nullptr ? "its module cannot be loaded" : reason};
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Splits a list of names at its commas.
std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> all;
  std::istringstream text(list);
  for (std::string name; std::getline(text, name, ',');) all.push_back(name);
  return all;
}

Result<std::unique_ptr<backends::Backend>> make(const std::string& name) {
  if (!has(mutant_names(), name) && !has(gate_mutant_names(), name) &&
      !has(rare_mutant_names(), name)) {
    return tl::unexpected(Error{"mutant:" + name, "", "no mutant of that name"});
  }
  const std::string path = RASTERCHECK_MUTANT_MODULES "/" + name + ".so";
  // RTLD_LOCAL, because two loaded mutants must not see each other's symbols. The module is never
  // closed, because it contains the backend's code.
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

/// Makes `mutants:A+B`: the rasterizer with several defects.
Result<std::unique_ptr<backends::Backend>> make_several(const std::string& options) {
  Result<std::unique_ptr<backends::Backend>> unharmed = backends::make_backend("cpu");
  if (!unharmed) return unharmed;
  std::vector<std::unique_ptr<backends::Backend>> damaged;
  std::istringstream text(options);
  for (std::string name; std::getline(text, name, '+');) {
    Result<std::unique_ptr<backends::Backend>> one = make(name);
    if (!one) return one;
    if (header_of(name).of != "cpu") {
      return tl::unexpected(Error{"mutants:" + options, "", "'" + name + "' is not of cpu"});
    }
    damaged.push_back(*std::move(one));
  }
  return std::make_unique<OverlaidBackend>(*std::move(unharmed), std::move(damaged));
}

std::vector<backends::Listing> list() {
  std::vector<backends::Listing> all;
  const auto add = [&all](const std::vector<std::string>& names, const char* what) {
    for (const std::string& name : names) {
      const auto made = make(name);
      all.push_back({"mutant:" + name, what, made ? std::string() : to_string(made.error())});
    }
  };
  add(mutant_names(), "the rasterizer with a defect");
  add(gate_mutant_names(), "the rasterizer, as precise or a little less");
  add(rare_mutant_names(), "the rasterizer with a defect that random cases do not show");
  return all;
}

const backends::BackendRegistration kRegistration({"mutant", &make, &list});
const backends::BackendRegistration kSeveral({"mutants", &make_several,
                                              [] { return std::vector<backends::Listing>(); }});

}  // namespace

const std::vector<std::string>& mutant_names() {
  static const std::vector<std::string> names = names_in(RASTERCHECK_MUTANT_NAMES);
  return names;
}

const std::vector<std::string>& gate_mutant_names() {
  static const std::vector<std::string> names = names_in(RASTERCHECK_GATE_MUTANT_NAMES);
  return names;
}

const std::vector<std::string>& rare_mutant_names() {
  static const std::vector<std::string> names = names_in(RASTERCHECK_RARE_MUTANT_NAMES);
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
  const std::string folder = has(gate_mutant_names(), mutant)   ? RASTERCHECK_GATE_MUTANT_PATCHES
                             : has(rare_mutant_names(), mutant) ? RASTERCHECK_RARE_MUTANT_PATCHES
                                                                : RASTERCHECK_MUTANT_PATCHES;
  std::ifstream patch(folder + "/" + mutant + ".patch");
  for (std::string line; std::getline(patch, line) && !line.starts_with("--- ");) {
    for (const auto& [name, value] : fields) {
      if (line.starts_with(name)) *value = line.substr(name.size());
    }
  }
  return header;
}

}  // namespace rastercheck::mutants

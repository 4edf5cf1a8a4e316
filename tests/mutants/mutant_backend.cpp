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

struct CloseLibrary {
  void operator()(void* library) const { dlclose(library); }
};
using Library = std::unique_ptr<void, CloseLibrary>;

/// A mutant's own backend, and what keeps its module loaded as long as it lives.
class MutantBackend : public backends::Backend {
 public:
  MutantBackend(Library library, std::unique_ptr<backends::Backend> backend)
      : library_(std::move(library)), backend_(std::move(backend)) {}

  cases::Contract contract(const cases::Case& c) const override { return backend_->contract(c); }
  Result<cases::Framebuffer> draw(const cases::Case& c) override { return backend_->draw(c); }
  bool traces() const override { return backend_->traces(); }
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const records::SampleAddress& at) override {
    return backend_->trace(c, at);
  }
  bool draws_pictures() const override { return backend_->draws_pictures(); }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    return backend_->draw_picture(c, pipeline);
  }
  bool draws_over() const override { return backend_->draws_over(); }
  Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         cases::Picture& picture) override {
    return backend_->draw_over(c, pipeline, picture);
  }
  std::vector<std::string> same_as() const override { return backend_->same_as(); }
  bool assembles() const override { return backend_->assembles(); }
  Result<cases::Framebuffer> draw_assembled(const cases::Case& c, cases::Topology topology,
                                            std::span<const std::uint32_t> indices) override {
    return backend_->draw_assembled(c, topology, indices);
  }
  bool transforms() const override { return backend_->transforms(); }
  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) override {
    return backend_->transform(c);
  }
  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) override {
    return backend_->transform_normals(model, normals);
  }

 private:
  Library library_;
  std::unique_ptr<backends::Backend> backend_;
};

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
  // RTLD_LOCAL: two mutants at once must not see each other's symbols.
  Library library(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (library == nullptr) return tl::unexpected(cannot_load(name));
  void* symbol = dlsym(library.get(), "rastercheck_make_mutant");
  if (symbol == nullptr) return tl::unexpected(cannot_load(name));
  const std::string of = header_of(name).of;
  const auto make_mutant = reinterpret_cast<backends::Backend* (*)(const char*)>(symbol);
  std::unique_ptr<backends::Backend> backend(make_mutant(of.c_str()));
  if (backend == nullptr) {
    return tl::unexpected(Error{"mutant:" + name, "", "its 'Of: " + of + "' is no backend"});
  }
  return std::make_unique<MutantBackend>(std::move(library), std::move(backend));
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
  const std::pair<std::string_view, std::string*> fields[] = {{"Defect: ", &header.defect},
                                                              {"Killed by: ", &header.killed_by},
                                                              {"Equivalent: ", &header.equivalent},
                                                              {"Of: ", &header.of},
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

#include "cli/case_check.h"

#include <fmt/format.h>

#include "cases/json.h"
#include "properties/campaign/check_case.h"

namespace rastercheck::cli {

Result<std::vector<const properties::Law*>> laws_for(const cases::Case& c,
                                                     const std::string& file) {
  std::vector<const properties::Law*> chosen;
  for (const properties::Law& law : properties::laws()) {
    if (!c.found || c.found->law == law.id) chosen.push_back(&law);
  }
  if (chosen.empty()) {
    return tl::unexpected(
        Error{file, "/found/property",
              fmt::format("no property is called '{}' (see rastercheck list properties)",
                          cases::printable(c.found->law))});
  }
  return chosen;
}

Result<Drawer> make_drawer(const backends::BackendFactory& factory,
                           const std::string& specification,
                           const properties::KnownSources& known_sources) {
  auto backend = factory.make(specification);
  if (!backend) return tl::unexpected(backend.error());
  auto known = properties::read_known_defects(known_sources, specification, **backend);
  if (!known) return tl::unexpected(known.error());
  return Drawer{*std::move(backend), *std::move(known)};
}

properties::Check check_again(const properties::Law& law, const cases::Case& c,
                              const Drawer& drawer) {
  const cases::Found found = c.found.value_or(cases::Found());
  properties::Check check = properties::check_or_note(law, c, *drawer.backend, found.index,
                                                      drawer.known ? &*drawer.known : nullptr);
  if (found.law == law.id) properties::put_alike_first(check, c, found);
  return check;
}

}  // namespace rastercheck::cli

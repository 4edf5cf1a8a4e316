// The backend `cpu`: this project's rasterizer.

#include "backends/backend.h"
#include "backends/cpu/rasterizer_backend.h"

namespace rastercheck::backends {
namespace {

Result<std::unique_ptr<Backend>> make(const std::string& options) {
  if (!options.empty()) {
    return tl::unexpected(Error{"cpu:" + options, "", "cpu takes no options yet"});
  }
  return make_rasterizer_backend("");
}

std::vector<Listing> list() { return {{"cpu", "this project's rasterizer", ""}}; }

const BackendRegistration kRegistration({"cpu", &make, &list});

}  // namespace
}  // namespace rastercheck::backends

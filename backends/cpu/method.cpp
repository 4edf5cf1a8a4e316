// The backends `method:NAME`, one for each textbook method.

#include "rasterizer/methods/method.h"

#include "backends/cpu/method_backend.h"
#include "backends/factory.h"

namespace rastercheck::backends::method_registration {
namespace {

Result<std::unique_ptr<Backend>> make(const std::string& name) {
  if (const rasterizer::Method* method = rasterizer::find_method(name)) {
    return make_method_backend(*method);
  }
  std::string known;
  for (const rasterizer::Method& method : rasterizer::methods()) {
    known += (known.empty() ? "" : ", ") + std::string(method.name);
  }
  return tl::unexpected(Error{"method:" + name, "", "unknown method; methods: " + known});
}

std::vector<Listing> list() {
  std::vector<Listing> all;
  for (const rasterizer::Method& method : rasterizer::methods()) {
    all.push_back({"method:" + std::string(method.name), std::string(method.source), ""});
  }
  return all;
}

const BackendRegistration kRegistration({"method", &make, &list});

}  // namespace
}  // namespace rastercheck::backends::method_registration

// The backend `cpu`: this project's rasterizer.

#include <sstream>

#include "backends/backend.h"
#include "backends/cpu/rasterizer_backend.h"

namespace rastercheck::backends {
namespace {

Result<std::unique_ptr<Backend>> make(const std::string& options) {
  using rasterizer::Precision;
  Precision precision = Precision::float64;
  Output output = Output::fragments;
  std::istringstream all(options);
  for (std::string option; std::getline(all, option, ',');) {
    if (option == "precision=float64") {
      precision = Precision::float64;
    } else if (option == "precision=float32") {
      precision = Precision::float32;
    } else if (option == "output=fragments") {
      output = Output::fragments;
    } else if (option == "output=framebuffer") {
      output = Output::framebuffer;
    } else {
      return tl::unexpected(
          Error{"cpu:" + options, "",
                "cpu has no option '" + option +
                    "'; there are: precision=float64 (the default), precision=float32, "
                    "output=fragments (the default), output=framebuffer"});
    }
  }
  return make_rasterizer_backend("", precision, output);
}

std::vector<Listing> list() {
  return {{"cpu", "this project's rasterizer", ""},
          {"cpu:precision=float32", "the same, with attributes computed in float32", ""},
          {"cpu:output=framebuffer", "the same, drawn tile by tile into a framebuffer", ""}};
}

const BackendRegistration kRegistration({"cpu", &make, &list});

}  // namespace
}  // namespace rastercheck::backends

// The backend `gl`: a driver for OpenGL or OpenGL ES.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/api_promise.h"
#include "backends/driver_root.h"
#include "backends/factory.h"
#include "backends/gl/case_drawer.h"
#include "backends/gl/context.h"
#include "backends/gl/driver_name.h"

namespace rastercheck::backends {
namespace {

/// Mesa's drivers that draw on the processor.
constexpr std::array<std::string_view, 2> kSoftware = {"llvmpipe", "softpipe"};

/// True if a driver of that name draws on the processor. ANGLE's names include that of the driver
/// below it.
bool is_software(std::string_view renderer) {
  constexpr std::array<std::string_view, 3> kNames{"llvmpipe", "softpipe", "SwiftShader"};
  return std::any_of(kNames.begin(), kNames.end(), [renderer](std::string_view name) {
    return renderer.find(name) != std::string_view::npos;
  });
}

/// OpenGL does not say how many bits it rounds places in textures to; Vulkan demands at least four.
/// Mesa's drivers that draw on the processor have eight.
constexpr int kSubtexelBits = 4;
constexpr int kSubtexelBitsOfMesa = 8;

class GlBackend : public Backend, public WaysOfDrawing, public PictureDrawer, public Assembler {
 public:
  GlBackend(gl::Context context, gl::CaseDrawer drawer)
      : context_(std::move(context)), drawer_(std::move(drawer)) {}

  About about() const override {
    const bool draws_on_processor = is_software(context_.renderer_name());
    return {.description = context_.renderer(),
            .driver = gl::driver_of(context_.renderer_name(), context_.version()),
            .api = ApiLimits{drawer_.subpixel_bits(), draws_on_processor,
                             drawer_.viewport_subpixel_bits(),
                             draws_on_processor ? kSubtexelBitsOfMesa : kSubtexelBits},
            .has_limits = true,
            .capabilities = drawer_.capabilities(),
            .ways = ways(),
            .draws_pictures = true,
            .assembles = true};
  }
  Assembler* assembler() override { return this; }
  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override {
    return drawer_.draw_assembled(c, topology, indices, [this] { go_on(); });
  }
  PictureDrawer* picture_drawer() override { return this; }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    return drawer_.draw_picture(c, pipeline);
  }
  WaysOfDrawing* ways_of_drawing() override { return this; }
  std::vector<cases::DrawBy> ways() const override { return drawer_.ways(); }
  Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way) override {
    return drawer_.draw(c, way, [this] { go_on(); });
  }
  cases::Contract promise(const cases::Case& c) const override {
    return api_promise(c, *about().api, *driver_promise());
  }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    return drawer_.draw(c, std::nullopt, [this] { go_on(); });
  }

  gl::Context context_;
  gl::CaseDrawer drawer_;
};

/// Sets environment variables before Mesa reads them; the user may override LP_NUM_THREADS.
void choose_driver(const std::string& name, const std::filesystem::path& root) {
  if (!name.empty()) {
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
    ::setenv("GALLIUM_DRIVER", name.c_str(), 1);
  }
  if (!root.empty()) {
    ::setenv("__EGL_VENDOR_LIBRARY_DIRS", (root / "usr/share/glvnd/egl_vendor.d").c_str(), 1);
    if (const auto libraries = libraries_of(root)) {
      ::setenv("LIBGL_DRIVERS_PATH", (*libraries / "dri").c_str(), 1);
      ::setenv("GBM_BACKENDS_PATH", (*libraries / "gbm").c_str(), 1);
    }
  }
  // A process that runs foreign code cannot write files.
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  // Campaigns run one process per processor, and cases are small.
  ::setenv("LP_NUM_THREADS", "0", 0);
}

Result<gl::ContextRequest> request_of(const std::string& options) {
  gl::ContextRequest request{gl::Api::opengl, 3, 3, gl::Prefer::hardware, ""};
  std::string_view rest = options;
  while (!rest.empty()) {
    const std::string_view option = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), option.size() + 1));
    if (option == "gles") {
      request.api = gl::Api::opengl_es;
      request.minor = 0;
    } else if (std::find(kSoftware.begin(), kSoftware.end(), option) != kSoftware.end()) {
      request.renderer = option;
      request.prefer = gl::Prefer::surfaceless;
    } else {
      return tl::unexpected(
          Error{"gl:" + options, "",
                "unknown option '" + std::string(option) + "'; options: llvmpipe, softpipe, gles"});
    }
  }
  return request;
}

Result<std::unique_ptr<Backend>> make(const std::string& options) {
  const RootedOptions rooted = split_root(options);
  const Result<gl::ContextRequest> request = request_of(rooted.options);
  if (!request) return tl::unexpected(request.error());
  const auto unavailable = [&](const Error& why) {
    return tl::unexpected(
        Error{options.empty() ? "gl" : "gl:" + options, "", why.reason, Failure::unavailable});
  };
  if (const Result<void> started = check_started_by(rooted.root); !started) {
    return unavailable(started.error());
  }
  if (!rooted.root.empty() && request->renderer.empty()) {
    return unavailable({"", "", "only llvmpipe and softpipe may come from a root"});
  }
  choose_driver(request->renderer, rooted.root);
  Result<gl::Context> context = gl::Context::create(*request);
  if (!context) return unavailable(context.error());
  if (const Result<void> loaded = check_loaded_from(rooted.root); !loaded) {
    return unavailable(loaded.error());
  }
  Result<gl::CaseDrawer> drawer = gl::CaseDrawer::create(*context);
  if (!drawer) return unavailable(drawer.error());
  return std::make_unique<GlBackend>(*std::move(context), *std::move(drawer));
}

std::vector<Listing> list() {
  std::vector<Listing> rows;
  for (const char* const name : {"gl", "gl:llvmpipe", "gl:softpipe"}) {
    rows.push_back({name, "an OpenGL driver"});
  }
  return rows;
}

const BackendRegistration kRegistration({"gl", &make, &list, true});

}  // namespace
}  // namespace rastercheck::backends
